#pragma once

#include <QString>

class QWidget;

namespace palp {

class NetworkSession;
class Scene;
class Workbench;

/// What a table or chart of a scene was made with, and whether that is still what is set; see exportLines.
QString exportSource(const Scene& scene, const QWidget& saved, Workbench& workbench, const NetworkSession& network);

/// What has changed since the touch that is shown was computed, as text; empty where nothing did.
QString touchStale(Workbench& workbench);

} // namespace palp
