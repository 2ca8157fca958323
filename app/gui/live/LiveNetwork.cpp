#include "app/gui/live/LiveNetwork.h"

#include "app/gui/project/FileKind.h"
#include "app/study/live/ForceDecoder.h"
#include "app/study/live/LiveSource.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "io/Fingerprint.h"

#include <filesystem>
#include <utility>

namespace palp {

LiveNetwork::LiveNetwork(QObject* parent) : QObject(parent) {
  connect(&loader_, &JobRunner::failed, this, &LiveNetwork::refused);
  connect(&loader_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) requested_ = fileInUse(); // otherwise read when next seen
  });
}

void LiveNetwork::follow(const LiveSettings& settings) {
  if (std::exchange(wantedFile_, settings.network) != settings.network) {
    requested_ = fileInUse(); // the one in use was restored
    if (requested_) loader_.cancel();
  }
  if (std::exchange(wantedCalibrated_, settings.calibrated) != settings.calibrated &&
      settings.calibrated != inUse_.calibrated)
    requested_ = false;
}

void LiveNetwork::load(const SimulatedDesign::Solved* solved, const std::optional<BoardInfo>& info) {
  const bool refined = wantedCalibrated_ && wantedCalibrated_ != inUse_.calibrated;
  const bool simulated = !refined && wantedFile_.empty() && solved != nullptr;
  if (refined || simulated) loader_.cancel();
  requested_ = true;
  if (refined) return useCalibrated(wantedCalibrated_, wantedFile_);
  if (simulated) {
    before_ = {};
    return use({solved->decoder, {}, {}, tr("Network of the simulated design"), true});
  }
  // A network that cannot read the connected board does not replace one that can.
  const std::optional<BoardInfo> board = inUse_.decoder ? info : std::nullopt;
  loader_.start(tr("Reading the network"), [this, file = wantedFile_, board](const std::stop_token&, JobProgress&) {
    if (!file.empty()) requireKind(QString::fromStdString(file), FileKind::Network);
    const std::filesystem::path path = file.empty() ? shippedNetwork() : std::filesystem::path(file);
    auto loaded =
        std::make_shared<Network>(Network{readNetwork(path), file, palp::fingerprint(readFile(path)), {}, false});
    if (!file.empty() && board)
      static_cast<void>(ForceDecoder(*loaded->decoder, *board)); // throws where it cannot read it
    return [this, loaded] { takeLoaded(std::move(*loaded)); };
  });
}

void LiveNetwork::takeLoaded(Network network) {
  Network inUse = inUse_;
  inUse.name = name();
  const bool first = std::exchange(anotherProject_, false);
  const bool restorable = inUse.decoder && inUse.file != network.file && !first;
  before_ = restorable ? std::move(inUse) : Network{};
  use(std::move(network));
}

void LiveNetwork::use(Network network) {
  inUse_ = std::move(network);
  emit changed();
  if (inUse_.decoder && requested_ && !loader_.running() && !namedBySettings()) emit otherInUse();
}

bool LiveNetwork::namedBySettings() const {
  return inUse_.file == wantedFile_ && inUse_.calibrated == wantedCalibrated_;
}

QString LiveNetwork::name() const {
  if (!inUse_.name.isEmpty()) return inUse_.name;
  if (inUse_.file.empty()) return tr("Built-in network");
  return QString::fromStdString(std::filesystem::path(inUse_.file).filename().string());
}

void LiveNetwork::refine(Decoder decoder, const QString& name) {
  before_ = inUse_;
  before_.name = this->name();
  emit marked(tr("network: %1").arg(name));
  useCalibrated(std::make_shared<const CalibratedNetwork>(CalibratedNetwork{std::move(decoder), name.toStdString()}),
                inUse_.file);
}

/// `file`: of the network that it was refined from.
void LiveNetwork::useCalibrated(const std::shared_ptr<const CalibratedNetwork>& calibrated, const std::string& file) {
  anotherProject_ = false;
  use({calibrated->decoder, file, {}, QString::fromStdString(calibrated->name), inUse_.ofSimulation, calibrated});
}

void LiveNetwork::restore() {
  if (before_.name.isEmpty()) return;
  Network back = std::exchange(before_, {});
  emit marked(tr("network: %1").arg(back.name));
  use(std::move(back));
  if (!namedBySettings()) emit otherInUse(); // while another one is being read, too
}

void LiveNetwork::forgetBefore() {
  before_ = {};
  anotherProject_ = loader_.running() || !requested_;
}

} // namespace palp
