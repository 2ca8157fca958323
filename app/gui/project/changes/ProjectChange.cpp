#include "app/gui/project/changes/ProjectChange.h"

#include "app/gui/design/DesignFields.h"
#include "app/gui/project/changes/NetworkChange.h"

#include <QObject>
#include <QStringList>

#include <algorithm>
#include <optional>
#include <vector>

namespace palp {

namespace {

/// Sizes of the block with the wires in the same shares of it as before: one change, however many numbers it moves.
QString scaledWords(const SensorDesign& before, const SensorDesign& after) {
  if (before.block_mm == after.block_mm || before.upper == after.upper) return {};
  SensorDesign rest = after; // all else is as it was
  rest.block_mm = before.block_mm;
  rest.upper = before.upper;
  rest.lower = before.lower;
  if (rest != before) return {};
  const auto places = [](const SensorDesign& design) {
    Eigen::Matrix3Xd all(3, design.upperElectrodes_mm().cols() + design.lowerElectrodes_mm().cols());
    all << design.upperElectrodes_mm(), design.lowerElectrodes_mm();
    return Eigen::Matrix3Xd(design.block_mm.cwiseInverse().asDiagonal() * all);
  };
  const Eigen::Matrix3Xd from = places(before), to = places(after);
  constexpr double kRounding = 1e-7; // of the places that scaling rounds
  if (from.cols() != to.cols() || (from - to).cwiseAbs().maxCoeff() > kRounding) return {};
  QStringList sizes;
  for (int d = 0; d < 3; ++d)
    if (before.block_mm[d] != after.block_mm[d])
      sizes << stepWords(QObject::tr("size along %1").arg(QChar("xyz"[d])), QString::number(before.block_mm[d]),
                         QString::number(after.block_mm[d]), "mm");
  return QObject::tr("block %1, and the wires with it").arg(sizes.join(", "));
}

/// What changed in the design; one sentence a parameter.
QStringList designChanges(const SensorDesign& before, const SensorDesign& after) {
  if (const QString scaled = scaledWords(before, after); !scaled.isEmpty()) return {scaled};
  QStringList changes;
  SensorDesign told = before; // with what the sentences say
  for (const DesignField& field : designFields()) {
    if (!field.has(after)) continue;
    const QString from = field.text(before), to = field.text(after);
    if (from == to || field.text(told) == to) continue; // the latter came with a law that was chosen
    if (!field.has(before)) {                           // comes with the law that was chosen
      field.set(told, to);
      continue;
    }
    changes << stepWords(field.group.toLower() + " " + field.label, from, to, field.unit);
    field.set(told, to);
  }
  if (told != after) changes << QString(); // more than the fields can say
  return changes;
}

QString forceWords(const Eigen::Vector3d& force_N) {
  return QString("(%1, %2, %3)").arg(force_N.x()).arg(force_N.y()).arg(force_N.z());
}

/// Of the load on one area; none: it carries none.
std::optional<Eigen::Vector3d> forceOn(const LoadCase& load, int area) {
  for (const AreaLoad& its : load.areas)
    if (its.area == area) return its.force_N;
  return std::nullopt;
}

QString pairWords(const Eigen::Vector2d& place_mm) {
  return QString("(%1, %2)").arg(place_mm.x()).arg(place_mm.y());
}

/// Of the discs; empty where that is more than one thing.
QString discChange(const std::vector<PatchLoad>& before, const std::vector<PatchLoad>& after) {
  const std::size_t same = static_cast<std::size_t>(
      std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first - before.begin());
  const QString name = QObject::tr("disc %1:").arg(same);
  if (after.size() == before.size() + 1 && same == before.size())
    return QObject::tr("%1 load of %2 N at %3 mm")
        .arg(name, forceWords(after[same].force_N), pairWords(after[same].centre_mm));
  if (after.size() + 1 == before.size() && std::equal(after.begin() + static_cast<std::ptrdiff_t>(same), after.end(),
                                                      before.begin() + static_cast<std::ptrdiff_t>(same) + 1))
    return QObject::tr("%1 removed").arg(name);
  if (after.size() != before.size()) return {};
  PatchLoad only = before[same];
  for (std::size_t k = same + 1; k < after.size(); ++k)
    if (before[k] != after[k]) return {};
  const PatchLoad& now = after[same];
  if (only.force_N != now.force_N) {
    const QString words = stepWords(name, forceWords(only.force_N), forceWords(now.force_N), "N");
    only.force_N = now.force_N;
    return only == now ? words : QString();
  }
  if (only.centre_mm == now.centre_mm)
    return stepWords(name + QObject::tr(" radius"), QString::number(only.radius_mm), QString::number(now.radius_mm),
                     "mm");
  if (only.radius_mm == now.radius_mm)
    return stepWords(name + QObject::tr(" centre"), pairWords(only.centre_mm), pairWords(now.centre_mm), "mm");
  return {};
}

/// In a change's words: what it is, where, and how it presses.
QString indenterWords(const Indenter& its) {
  QString words = QString::fromStdString(shapeName(its.shape));
  if (its.shape != IndenterShape::Plane) words += QString(" %1 mm").arg(its.radius_mm);
  if (const Press* press = its.press())
    words += " " + forceWords(press->force_N) + " N";
  else
    words += QObject::tr(" %1 mm deep").arg(its.motion()->depth_mm);
  return words;
}

/// Of the indenters; empty where that is more than one thing.
QString indenterChange(const std::vector<Indenter>& before, const std::vector<Indenter>& after) {
  const auto same = static_cast<std::size_t>(
      std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first - before.begin());
  const QString name = QObject::tr("indenter %1:").arg(same);
  if (after.size() == before.size() + 1 && same == before.size())
    return QString("%1 %2").arg(name, indenterWords(after[same]));
  if (after.size() + 1 == before.size()) return QObject::tr("%1 removed").arg(name);
  if (after.size() != before.size()) return {};
  const Indenter &from = before[same], &to = after[same];
  Indenter moved = from;
  moved.place_mm = to.place_mm;
  if (moved == to)
    return stepWords(name + QObject::tr(" position"), pairWords(from.place_mm), pairWords(to.place_mm), "mm");
  Indenter rubbed = from;
  rubbed.friction = to.friction;
  if (rubbed == to)
    return stepWords(name + QObject::tr(" friction"), QString::number(from.friction), QString::number(to.friction));
  return stepWords(name, indenterWords(from), indenterWords(to));
}

QStringList loadChanges(const LoadCase& before, const LoadCase& after) {
  QStringList changes;
  if (before.patches != after.patches) changes << discChange(before.patches, after.patches);
  if (before.indenters != after.indenters) changes << indenterChange(before.indenters, after.indenters);
  std::vector<int> areas;
  for (const LoadCase* load : {&before, &after})
    for (const AreaLoad& its : load->areas)
      if (std::find(areas.begin(), areas.end(), its.area) == areas.end()) areas.push_back(its.area);
  for (const int area : areas) {
    const auto from = forceOn(before, area), to = forceOn(after, area);
    if (from == to) continue;
    const QString name = QObject::tr("area %1:").arg(area);
    if (from && to)
      changes << stepWords(name, forceWords(*from), forceWords(*to), "N");
    else if (to)
      changes << QObject::tr("%1 load of %2 N").arg(name, forceWords(*to));
    else
      changes << QObject::tr("%1 no load").arg(name);
  }
  return changes;
}

QString meshWords(const MeshOptions& mesh) {
  if (mesh.mapped) return QString("%1x%2x%3").arg((*mesh.mapped)[0]).arg((*mesh.mapped)[1]).arg((*mesh.mapped)[2]);
  return mesh.meshSize_mm ? QString("%1 mm").arg(*mesh.meshSize_mm) : QObject::tr("standard");
}

} // namespace

QString sinceWords(const Project& then, const Project& now) {
  constexpr qsizetype kNamed = 2;
  QStringList changes = designChanges(then.design, now.design);
  if (changes.isEmpty()) changes << loadChanges(then.load, now.load);
  if (then.path != now.path) changes << QObject::tr("path of the indenter");
  if (then.mesh != now.mesh) changes << stepWords(QObject::tr("mesh size"), meshWords(then.mesh), meshWords(now.mesh));
  changes.removeAll(QString());
  if (changes.isEmpty()) return {};
  const qsizetype more = changes.size() - kNamed;
  const QString words = changes.mid(0, kNamed).join(", ");
  return more > 0 ? QObject::tr("%1 and %2 more since").arg(words).arg(more) : QObject::tr("%1 since").arg(words);
}

QString changeWords(const QString& what, const Project& before, const Project& after) {
  QStringList changes = designChanges(before.design, after.design);
  // A design removes the loads that cannot act on it: that is not a separate change.
  if (changes.isEmpty()) changes << loadChanges(before.load, after.load);
  if (before.mesh != after.mesh)
    changes << stepWords(QObject::tr("mesh size"), meshWords(before.mesh), meshWords(after.mesh));
  const QStringList learned =
      networkChanges(before.network, after.network) + sampleChanges(before.samples, after.samples);
  if (before.path != after.path || changes.size() + learned.size() != 1 || (changes + learned).front().isEmpty())
    return what;
  // Networks are changed by actions that have names of their own: the best spread of a sweep, a network gone back to.
  return changes.isEmpty() ? QString("%1 (%2)").arg(what, learned.front()) : changes.front();
}

} // namespace palp
