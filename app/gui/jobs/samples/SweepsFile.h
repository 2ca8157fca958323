#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QByteArray>

namespace palp {

/// The sweep of the spread and the comparison of decoders, a file in the folder of their samples. Errors that are not
/// finite are null.
QByteArray sweepsText(const NetworkResults& results);

/// Sets sweep and comparison of `results`, whose samples must be set; `file` is for messages. Throws Error where the
/// text is not such a file, or belongs to other samples.
void parseSweeps(const QByteArray& text, const QString& file, NetworkResults& results);

} // namespace palp
