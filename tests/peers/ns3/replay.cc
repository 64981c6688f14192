/* SPDX-License-Identifier: GPL-2.0-only
 *
 * Sends given datagrams through ns-3's Wi-Fi and says when each of them has arrived. It is a program of
 * its own, under the licence of ns-3 whose libraries it uses; nothing of stormproof is linked with it.
 *
 * One access point, one station for each host, a metre apart, at a constant rate. A datagram is sent
 * as Linux sends it: in IP fragments, all at once, as soon as its sender's send buffer has room.
 *
 * stdin: `datagram <ns> <sender> <host> <to host, or -1 for all> <UDP payload bytes>`, by time.
 * stdout: for each of them, in the same order, `<ns of the last fragment's arrival, or -1> <ns at which
 * it entered the send buffer>`.
 */
#include <algorithm>
#include <cstring>
#include <deque>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "ns3/core-module.h"
#include "ns3/ap-wifi-mac.h"
#include "ns3/constant-position-mobility-model.h"
#include "ns3/he-configuration.h"
#include "ns3/ht-configuration.h"
#include "ns3/mobility-helper.h"
#include "ns3/node-container.h"
#include "ns3/ssid.h"
#include "ns3/wifi-mpdu.h"
#include "ns3/wifi-net-device.h"
#include "ns3/yans-wifi-helper.h"

namespace {

using namespace ns3;

struct Datagram {
  uint64_t at = 0;
  uint32_t sender = 0;
  uint32_t host = 0;
  int32_t to = -1;
  uint32_t bytes = 0;
  int64_t entered = -1;
  int64_t arrived = -1;
  uint32_t fragments = 0;
  uint32_t uplinks = 0;  // fragments that the access point does not have yet
  uint32_t missing = 0;  // (fragment, receiver) pairs that have not arrived
};

struct Sender {
  std::deque<uint32_t> backlog;
  int64_t used = 0;
};

/// What a frame's payload begins with, so that it is known wherever it comes by.
struct Mark {
  uint32_t datagram;
  uint32_t fragment;
};

constexpr uint32_t kIpHeader = 20;
constexpr uint32_t kUdpHeader = 8;
constexpr uint16_t kProtocol = 0x0800;
constexpr uint32_t kLlcHeader = 8;

struct Options {
  std::string standard = "80211n";
  std::string mode = "HtMcs15";
  uint32_t width = 20;
  uint32_t hosts = 2;
  uint32_t fragment = 1480;
  int64_t buffer = 212992;
  uint32_t link = 38;  // bytes of link headers that count in the send buffer
  uint32_t ampdu = 65535;
  uint32_t window = 64;
};

class Replay {
 public:
  Replay(const Options& options, std::vector<Datagram> datagrams)
      : options_(options), datagrams_(std::move(datagrams)) {
    Build();
  }

  void Run() {
    for (uint32_t h = 0; h < options_.hosts; ++h) {
      Simulator::Schedule(kStart - MilliSeconds(900 - 10 * (h % 50)), &Replay::Greet, this, h);
    }
    for (uint32_t k = 0; k < datagrams_.size(); ++k) {
      Simulator::Schedule(kStart + NanoSeconds(datagrams_[k].at), &Replay::Emit, this, k);
    }
    const uint64_t last = datagrams_.empty() ? 0 : datagrams_.back().at;
    Simulator::Stop(kStart + NanoSeconds(last) + Seconds(600));
    Simulator::Run();
    Simulator::Destroy();
  }

  const std::vector<Datagram>& Datagrams() const { return datagrams_; }

 private:
  // Until then the stations have associated, and agreed on Block Acks.
  const Time kStart = Seconds(3);
  static constexpr uint32_t kGreeting = UINT32_MAX;

  void Build() {
    NodeContainer stations;
    stations.Create(options_.hosts);
    NodeContainer point;
    point.Create(1);

    WifiHelper wifi;
    const std::map<std::string, WifiStandard> standards = {
        {"80211n", WIFI_STANDARD_80211n},
        {"80211ac", WIFI_STANDARD_80211ac},
        {"80211ax", WIFI_STANDARD_80211ax}};
    wifi.SetStandard(standards.at(options_.standard));
    wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode",
                                 StringValue(options_.mode), "ControlMode",
                                 StringValue("OfdmRate24Mbps"), "NonUnicastMode",
                                 WifiModeValue(WifiMode("OfdmRate6Mbps")));
    YansWifiPhyHelper phy;
    phy.SetChannel(YansWifiChannelHelper::Default().Create());
    phy.Set("ChannelSettings",
            StringValue("{0, " + std::to_string(options_.width) + ", BAND_5GHZ, 0}"));
    phy.Set("Antennas", UintegerValue(2));
    phy.Set("MaxSupportedTxSpatialStreams", UintegerValue(2));
    phy.Set("MaxSupportedRxSpatialStreams", UintegerValue(2));

    const Ssid ssid("stormproof");
    WifiMacHelper mac;
    const auto install = [&](const NodeContainer& nodes) {
      const NetDeviceContainer devices = wifi.Install(phy, mac, nodes);
      for (uint32_t k = 0; k < devices.GetN(); ++k) Configure(devices.Get(k));
      return devices;
    };
    mac.SetType("ns3::StaWifiMac", "Ssid", SsidValue(ssid), "BE_MaxAmpduSize",
                UintegerValue(options_.ampdu), "BE_MaxAmsduSize", UintegerValue(0));
    const NetDeviceContainer of_stations = install(stations);
    mac.SetType("ns3::ApWifiMac", "Ssid", SsidValue(ssid), "BE_MaxAmpduSize",
                UintegerValue(options_.ampdu), "BE_MaxAmsduSize", UintegerValue(0));
    const NetDeviceContainer of_point = install(point);
    wifi.AssignStreams(of_stations, 1000);
    wifi.AssignStreams(of_point, 2000);

    MobilityHelper mobility;
    mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel");
    mobility.Install(point);
    mobility.Install(stations);
    for (uint32_t h = 0; h < options_.hosts; ++h) {
      stations.Get(h)->GetObject<MobilityModel>()->SetPosition(Vector(1.0 + 0.01 * h, 0, 0));
      const Ptr<WifiNetDevice> device = DynamicCast<WifiNetDevice>(of_stations.Get(h));
      devices_.push_back(device);
      device->SetReceiveCallback(MakeCallback(&Replay::Receive, this));
      device->GetMac()->TraceConnectWithoutContext("AckedMpdu",
                                                   MakeCallback(&Replay::Acknowledged, this));
      device->GetMac()->TraceConnectWithoutContext("DroppedMpdu",
                                                   MakeCallback(&Replay::Dropped, this));
      host_of_[device] = h;
    }
    of_point.Get(0)->SetReceiveCallback(MakeCallback(&Replay::Ignore, this));
  }

  void Configure(const Ptr<NetDevice>& net_device) const {
    const Ptr<WifiNetDevice> device = DynamicCast<WifiNetDevice>(net_device);
    device->GetHtConfiguration()->SetShortGuardIntervalSupported(true);
    if (device->GetHeConfiguration() != nullptr) {
      device->GetHeConfiguration()->SetGuardInterval(NanoSeconds(800));
      device->GetHeConfiguration()->SetMpduBufferSize(options_.window);
    }
  }

  bool Ignore(Ptr<NetDevice>, Ptr<const Packet>, uint16_t, const Address&) { return true; }

  uint32_t FragmentBytes(const Datagram& d, uint32_t fragment) const {
    const uint32_t payload = kUdpHeader + d.bytes;
    const uint32_t begin = fragment * options_.fragment;
    return kIpHeader + std::min(options_.fragment, payload - begin);
  }

  int64_t Demand(const Datagram& d) const {
    return int64_t{d.bytes} + kUdpHeader + int64_t{d.fragments} * (kIpHeader + options_.link);
  }

  void Emit(uint32_t index) {
    Datagram& d = datagrams_[index];
    d.fragments = (kUdpHeader + d.bytes + options_.fragment - 1) / options_.fragment;
    d.uplinks = d.fragments;
    d.missing = d.fragments * (d.to < 0 ? options_.hosts - 1 : 1);
    Sender& sender = senders_[d.sender];
    sender.backlog.push_back(index);
    Admit(sender);
  }

  void Admit(Sender& sender) {
    while (!sender.backlog.empty()) {
      const uint32_t index = sender.backlog.front();
      Datagram& d = datagrams_[index];
      if (sender.used > 0 && sender.used + Demand(d) > options_.buffer) return;
      sender.backlog.pop_front();
      sender.used += Demand(d);
      d.entered = (Simulator::Now() - kStart).GetNanoSeconds();
      for (uint32_t f = 0; f < d.fragments; ++f) Send(d, index, f);
    }
  }

  // Several frames at once, so that there is something to aggregate in both directions.
  void Greet(uint32_t host) {
    for (uint32_t k = 0; k < 4 * options_.hosts; ++k) {
      const uint32_t to = k % options_.hosts;
      if (to != host) SendFrame(host, static_cast<int32_t>(to), {kGreeting, 0}, 100);
    }
  }

  void Send(const Datagram& d, uint32_t index, uint32_t fragment) {
    SendFrame(d.host, d.to, {index, fragment}, FragmentBytes(d, fragment));
  }

  void SendFrame(uint32_t host, int32_t to, const Mark& mark, uint32_t size) {
    std::vector<uint8_t> bytes(std::max<size_t>(size, sizeof mark));
    std::memcpy(bytes.data(), &mark, sizeof mark);
    const Address receiver = to < 0 ? Address(Mac48Address::GetBroadcast())
                                    : devices_[static_cast<uint32_t>(to)]->GetAddress();
    devices_[host]->Send(Create<Packet>(bytes.data(), bytes.size()), receiver, kProtocol);
  }

  static Mark MarkOf(const Ptr<const Packet>& packet, uint32_t behind) {
    std::vector<uint8_t> bytes(packet->GetSize());
    packet->CopyData(bytes.data(), bytes.size());
    Mark mark{};
    std::memcpy(&mark, bytes.data() + behind, sizeof mark);
    return mark;
  }

  void Leave(const Ptr<const WifiMpdu>& mpdu) {
    if (!mpdu->GetHeader().IsData() || !mpdu->GetHeader().HasData()) return;
    const Mark mark = MarkOf(mpdu->GetPacket(), kLlcHeader);
    if (mark.datagram == kGreeting) return;
    Datagram& d = datagrams_.at(mark.datagram);
    if (d.uplinks == 0 || --d.uplinks > 0) return;
    Sender& sender = senders_[d.sender];
    sender.used -= Demand(d);
    Admit(sender);
  }
  void Acknowledged(Ptr<const WifiMpdu> mpdu) { Leave(mpdu); }
  void Dropped(WifiMacDropReason, Ptr<const WifiMpdu> mpdu) { Leave(mpdu); }

  bool Receive(Ptr<NetDevice> device, Ptr<const Packet> packet, uint16_t protocol, const Address&) {
    if (protocol != kProtocol) return true;
    const Mark mark = MarkOf(packet, 0);
    if (mark.datagram == kGreeting) return true;
    Datagram& d = datagrams_.at(mark.datagram);
    if (d.host == host_of_[device] || d.missing == 0) return true;
    if (--d.missing == 0) {
      d.arrived = (Simulator::Now() - kStart).GetNanoSeconds();
      if (++arrived_ == datagrams_.size()) Simulator::Stop();
    }
    return true;
  }

  Options options_;
  std::vector<Datagram> datagrams_;
  std::map<uint32_t, Sender> senders_;
  std::vector<Ptr<WifiNetDevice>> devices_;
  std::map<Ptr<NetDevice>, uint32_t> host_of_;
  size_t arrived_ = 0;
};

std::vector<Datagram> ReadDatagrams(const Options& options) {
  std::vector<Datagram> datagrams;
  std::string word;
  while (std::cin >> word) {
    Datagram d;
    if (word != "datagram" || !(std::cin >> d.at >> d.sender >> d.host >> d.to >> d.bytes) ||
        d.host >= options.hosts || d.to >= static_cast<int32_t>(options.hosts)) {
      std::cerr << "replay: datagram " << datagrams.size() + 1
                << ": expected 'datagram <ns> <sender> <host> <to host or -1> <bytes>'\n";
      std::exit(2);
    }
    datagrams.push_back(d);
  }
  return datagrams;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  uint32_t seed = 1;
  CommandLine command(__FILE__);
  command.AddValue("standard", "80211n, 80211ac or 80211ax", options.standard);
  command.AddValue("mode", "constant rate of unicast data, such as HtMcs15", options.mode);
  command.AddValue("width", "of the channel in MHz", options.width);
  command.AddValue("hosts", "stations", options.hosts);
  command.AddValue("fragment", "bytes of IP payload in a fragment", options.fragment);
  command.AddValue("buffer", "bytes of a send buffer", options.buffer);
  command.AddValue("link", "bytes of link headers that count in it", options.link);
  command.AddValue("ampdu", "greatest A-MPDU in bytes; 0: one frame for each access", options.ampdu);
  command.AddValue("window", "frames in an A-MPDU at most", options.window);
  command.AddValue("seed", "of the random backoff", seed);
  command.Parse(argc, argv);

  // Queues that lose nothing: a host's send buffer is the only limit.
  Config::SetDefault("ns3::WifiMacQueue::MaxSize", StringValue("10000000p"));
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100000)));
  Config::SetDefault("ns3::WifiRemoteStationManager::RtsCtsThreshold", UintegerValue(4692480));
  RngSeedManager::SetRun(seed);

  Replay replay(options, ReadDatagrams(options));
  replay.Run();
  for (const Datagram& d : replay.Datagrams()) std::cout << d.arrived << ' ' << d.entered << '\n';
}
