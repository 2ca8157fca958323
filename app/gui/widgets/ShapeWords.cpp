#include "app/gui/widgets/ShapeWords.h"

#include <QObject>

namespace palp {

QString inWords(IndenterShape shape) {
  switch (shape) {
  case IndenterShape::Sphere:
    return QObject::tr("sphere");
  case IndenterShape::Pin:
    return QObject::tr("pin, round end");
  case IndenterShape::Flat:
    return QObject::tr("flat punch");
  case IndenterShape::CylinderX:
    return QObject::tr("cylinder along x");
  case IndenterShape::CylinderY:
    return QObject::tr("cylinder along y");
  case IndenterShape::Plane:
    return QObject::tr("plane");
  }
  return {};
}

} // namespace palp
