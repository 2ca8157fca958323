#include "app/gui/widgets/Png.h"

#include <QBuffer>

namespace palp {

QByteArray pngOf(const QPixmap& picture) {
  QBuffer bytes;
  bytes.open(QIODevice::WriteOnly);
  picture.save(&bytes, "PNG");
  return bytes.data();
}

} // namespace palp
