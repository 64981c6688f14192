// The access point of the live bed: a TAP device for each host, one half-duplex channel. Prints
// "ready" and the names as soon as the devices exist, so that a script can move them into the
// network namespaces of its hosts; serves until SIGINT, SIGTERM or SIGHUP; then says what it did.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/output_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "tests/live/access_point/relay.hpp"
#include "tests/live/access_point/serving_profile.hpp"

namespace stormproof::live {

namespace {

struct Arguments {
  std::vector<std::string> taps;
  std::string wireless = "emulated-ap";
  std::vector<std::string> overrides;
  std::string overhead;
  double loss = 0;
  std::uint64_t seed = 1;
  std::uint64_t queue_frames = 0;  ///< 0: unlimited
  std::uint64_t station_queue_frames = 0;
  std::string statistics;
  std::string pid_file;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--tap", arguments.taps, "A TAP device to create; give it once for each host")
      ->required()
      ->expected(2, static_cast<int>(most_stations))
      ->allow_extra_args(false)
      ->type_name("NAME");
  app.add_option("--wireless", arguments.wireless, "Wireless profile: name or file")
      ->capture_default_str()
      ->type_name("PROFILE");
  app.add_option("--set", arguments.overrides,
                 "Override a key of the profile: key.path=value (repeatable)")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  app.add_option("--overhead", arguments.overhead,
                 "Both overheads of the profile, for example 150us")
      ->type_name("DURATION");
  app.add_option("--loss", arguments.loss,
                 "Probability that a downlink transmission is lost, each independently")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("0..1");
  app.add_option("--seed", arguments.seed, "Seed of the losses")->capture_default_str();
  const auto frames = CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32U);
  app.add_option("--queue-frames", arguments.queue_frames,
                 "Most frames that wait for their downlink; others are dropped [unlimited]")
      ->check(frames)
      ->type_name("N");
  app.add_option("--station-queue-frames", arguments.station_queue_frames,
                 "Most frames of one host that wait for their uplink [unlimited]")
      ->check(frames)
      ->type_name("N");
  app.add_option("--statistics", arguments.statistics, "Write JSON statistics at the end")
      ->type_name("FILE");
  app.add_option("--pid-file", arguments.pid_file, "Holds the process id while it serves")
      ->type_name("FILE");
  app.footer("Needs root, or CAP_NET_ADMIN. Exit code: 0 ended by a signal, 2 bad input.");
}

int complain(const std::string& message) {
  fmt::print(stderr, "stormproof_access_point: {}\n", message);
  return cli::bad_input;
}

std::optional<std::uint64_t> limit(std::uint64_t frames) {
  return frames == 0 ? std::nullopt : std::optional{frames};
}

/// A file descriptor that becomes readable when this process is asked to end.
int end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

/// The process id in a file, for as long as this object lives.
class PidFile {
 public:
  explicit PidFile(std::string path) : path_{std::move(path)} {}
  PidFile(const PidFile&) = delete;
  PidFile& operator=(const PidFile&) = delete;
  ~PidFile() {
    std::error_code ignored;
    if (written_) std::filesystem::remove(path_, ignored);
  }

  [[nodiscard]] std::optional<std::string> write() {
    cli::OutputFile file{path_};
    if (auto error = file.open_error()) return error;
    if (file.wanted()) file.stream() << getpid() << '\n';
    auto error = file.commit();
    written_ = file.wanted() && !error;
    return error;
  }

 private:
  std::string path_;
  bool written_ = false;
};

int serve(const Arguments& arguments) {
  const auto wireless =
      read_serving_profile(arguments.wireless, arguments.overrides, arguments.overhead);
  if (!wireless) return complain(to_string(wireless.error()));
  for (const std::string& remark : left_to_the_hosts(*wireless)) {
    fmt::print(stderr, "stormproof_access_point: note: {}\n", remark);
  }
  const Setting setting{arguments.taps,
                        *wireless,
                        {limit(arguments.station_queue_frames), limit(arguments.queue_frames)},
                        {arguments.loss, arguments.seed}};
  cli::OutputFile statistics{arguments.statistics};
  if (const auto error = statistics.open_error()) return complain(*error);

  const int stop = end_signals();
  const std::int64_t mtu = wireless->mtu_payload_bytes.count() + model::ip_header_bytes;
  std::vector<TapDevice> taps;
  for (const std::string& name : setting.taps) {
    auto tap = TapDevice::create(name, mtu);
    if (!tap) return complain(tap.error());
    taps.push_back(std::move(*tap));
  }
  PidFile pid_file{arguments.pid_file};
  if (const auto error = pid_file.write()) return complain(*error);

  HalfDuplexChannel channel{*wireless, setting.limits, setting.losses,
                            static_cast<std::uint32_t>(taps.size())};
  Relay relay{channel, taps};
  fmt::print("ready {}\n", fmt::join(setting.taps, " "));
  std::fflush(stdout);
  const std::optional<std::string> trouble = relay.run(stop);

  if (statistics.wanted()) {
    statistics.stream() << to_json(setting, channel.statistics(), relay.statistics());
  }
  if (const auto error = statistics.commit()) return complain(*error);
  return trouble ? complain(*trouble) : cli::established;
}

int run(int argc, char** argv) {
  CLI::App app{
      "The access point of the live bed: serves every frame of its TAP devices twice on one "
      "half-duplex channel, as the model has it"};
  app.name("stormproof_access_point");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::established : cli::bad_input;
  }
  return serve(arguments);
}

}  // namespace

}  // namespace stormproof::live

int main(int argc, char** argv) {
  try {
    return stormproof::live::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stormproof_access_point: internal error: {}\n", error.what());
  }
  return stormproof::cli::internal_error;
}
