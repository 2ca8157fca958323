#pragma once

#include <QString>

namespace palp {

class NetworkSession;
class Scene;
class Workbench;

/// What the tables of a scene were made with, and whether that is still what is set; see exportLines.
QString exportSource(const Scene& scene, Workbench& workbench, const NetworkSession& network);

/// What has changed since the touch that is shown was computed, in words; empty where nothing did.
QString touchStale(Workbench& workbench);

} // namespace palp
