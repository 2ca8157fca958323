#pragma once

#include <QByteArray>
#include <QPixmap>

namespace palp {

/// The bytes of a PNG file of the picture.
QByteArray pngOf(const QPixmap& picture);

} // namespace palp
