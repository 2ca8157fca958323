#pragma once

#include <Eigen/Core>

#include <QJsonObject>
#include <QString>
#include <QStringList>

#include <vector>

namespace palp {

/// An object of a JSON file together with where it stands: reads strictly, refuses with file, key, value and what is
/// allowed.
class ProjectPlace {
public:
  ProjectPlace(QJsonObject object, QString file, QString key = {});

  [[noreturn]] void refuse(const QString& key, const QString& allowed) const;
  void onlyKeys(const QStringList& keys) const;
  [[nodiscard]] double number(const QString& key, double low, double high) const;
  [[nodiscard]] int integer(const QString& key, int low, int high) const;
  [[nodiscard]] bool boolean(const QString& key) const;
  /// One of the words; any text where there are none.
  [[nodiscard]] QString word(const QString& key, const QStringList& words = {}) const;
  [[nodiscard]] ProjectPlace at(const QString& key) const;
  [[nodiscard]] std::vector<ProjectPlace> list(const QString& key) const;
  [[nodiscard]] Eigen::VectorXd numbers(const QString& key, Eigen::Index count) const;
  [[nodiscard]] bool has(const QString& key) const { return object_.contains(key); }
  [[nodiscard]] QJsonObject object() const { return object_; }

private:
  QJsonObject object_;
  QString file_;
  QString key_;
};

} // namespace palp
