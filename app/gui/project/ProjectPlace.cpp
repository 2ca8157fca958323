#include "app/gui/project/ProjectPlace.h"

#include "model/base/Error.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <cmath>

namespace palp {

ProjectPlace::ProjectPlace(QJsonObject object, QString file, QString key)
    : object_(std::move(object)), file_(std::move(file)), key_(std::move(key)) {}

void ProjectPlace::refuse(const QString& key, const QString& allowed) const {
  const QString where = key_.isEmpty() ? key : key_ + "." + key;
  const QJsonValue value = object_.value(key);
  const QString text =
      value.isUndefined() ? "missing" : QJsonDocument(QJsonArray{value}).toJson(QJsonDocument::Compact);
  throw Error((file_ + ": " + where + ": " + text + "; allowed is " + allowed).toStdString());
}

void ProjectPlace::onlyKeys(const QStringList& keys) const {
  for (const QString& key : object_.keys())
    if (!keys.contains(key)) refuse(key, "one of " + keys.join(", ") + " as a key");
}

double ProjectPlace::number(const QString& key, double low, double high) const {
  const QJsonValue value = object_.value(key);
  if (!value.isDouble() || !(value.toDouble() >= low && value.toDouble() <= high))
    refuse(key, QString("a number from %1 to %2").arg(low).arg(high));
  return value.toDouble();
}

int ProjectPlace::integer(const QString& key, int low, int high) const {
  const double value = number(key, low, high);
  if (value != std::floor(value)) refuse(key, QString("a whole number from %1 to %2").arg(low).arg(high));
  return static_cast<int>(value);
}

bool ProjectPlace::boolean(const QString& key) const {
  if (!object_.value(key).isBool()) refuse(key, "true or false");
  return object_.value(key).toBool();
}

QString ProjectPlace::word(const QString& key, const QStringList& words) const {
  const QJsonValue value = object_.value(key);
  if (!value.isString() || (!words.isEmpty() && !words.contains(value.toString())))
    refuse(key, words.isEmpty() ? "a text" : words.join(", "));
  return value.toString();
}

ProjectPlace ProjectPlace::at(const QString& key) const {
  if (!object_.value(key).isObject()) refuse(key, "an object");
  return {object_.value(key).toObject(), file_, key_.isEmpty() ? key : key_ + "." + key};
}

std::vector<ProjectPlace> ProjectPlace::list(const QString& key) const {
  if (!object_.value(key).isArray()) refuse(key, "a list of objects");
  std::vector<ProjectPlace> places;
  for (const QJsonValue value : object_.value(key).toArray()) {
    if (!value.isObject()) refuse(key, "a list of objects");
    places.emplace_back(value.toObject(), file_, key + "[" + QString::number(places.size()) + "]");
  }
  return places;
}

Eigen::VectorXd ProjectPlace::numbers(const QString& key, Eigen::Index count) const {
  const QJsonArray array = object_.value(key).toArray();
  bool good = object_.value(key).isArray() && array.size() == count;
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; good && k < count; ++k) {
    good = array[k].isDouble();
    values[k] = array[k].toDouble();
  }
  if (!good) refuse(key, QString("a list of %1 numbers").arg(count));
  return values;
}

} // namespace palp
