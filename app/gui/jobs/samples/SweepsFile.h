#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QByteArray>

namespace palp {

/// The sweep of the spread and the comparison of decoders that were made of samples, as they lie beside these in a
/// folder; read back as strictly as every file of ours. Errors that are no number stand as null.
QByteArray sweepsText(const NetworkResults& results);

/// Sets sweep and comparison of `results`, whose samples are there; `file` is for refusals. Throws Error where the text
/// is none of these, or of other samples.
void parseSweeps(const QByteArray& text, const QString& file, NetworkResults& results);

} // namespace palp
