// Messages: a job's number goes out with the tag `job`; its outcome comes back with `outcome`, or
// with `interrupted` if the rank was told to end. `end` goes to each rank once, and each answers
// with `farewell` after everything else that it has to say, so that no message is left behind.
// Nobody blocks in a receive: ranks may share cores, and waiting ones should not keep them busy.
#include "checker/experiments/sweep/mpi_ranks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#ifdef STORMPROOF_HAS_MPI
#include <mpi.h>
#endif

namespace stormproof::sweep {

namespace {

int number_in(const char* variable, int absent) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return absent;
  int value = absent;
  std::from_chars(text, text + std::strlen(text), value);
  return value;
}

}  // namespace

Launch launch() {
  // Open MPI; MPICH and its relatives.
  constexpr std::array<std::array<const char*, 2>, 2> variables{
      {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}}};
  for (const auto& [ranks, rank] : variables) {
    const Launch found{number_in(ranks, 1), number_in(rank, 0)};
    if (found.ranks > 1) return found;
  }
  return {};
}

#ifndef STORMPROOF_HAS_MPI

MpiWorld::MpiWorld()
    : error_{
          "started by mpirun with several ranks, but this program was built without MPI; "
          "install Open MPI (libopenmpi-dev) and build again, or start it without mpirun"} {}
MpiWorld::~MpiWorld() = default;
bool MpiWorld::agree_on(const Plan&) const { return false; }
void MpiWorld::distribute(Collector&) const {}
void MpiWorld::dismiss() const {}
void MpiWorld::work(const Plan&, const std::function<bool()>&) const {}

#else

namespace {

enum Tag : int { job_tag = 1, outcome_tag, interrupted_tag, end_tag, farewell_tag };

constexpr std::chrono::microseconds pause{200};
/// Rank 0 has handed out jobs for longer than this, and every look costs some microseconds.
constexpr std::chrono::milliseconds pause_of_first{2};

/// An outcome on its way: the numbers, then the texts.
struct Message {
  std::uint64_t job = 0;
  std::uint32_t present = 0;  ///< bit k: there is a number k
  std::uint32_t end_bytes = 0;
  std::array<std::int64_t, number_names.size()> numbers{};
  double wall_seconds = 0;
  double cpu_seconds = 0;
};

std::string pack(std::size_t job, const Outcome& outcome) {
  Message message;
  message.job = job;
  message.end_bytes = static_cast<std::uint32_t>(outcome.end.size());
  for (std::size_t k = 0; k < number_names.size(); ++k) {
    if (outcome.numbers[k]) message.present |= 1U << k;
    message.numbers[k] = outcome.numbers[k].value_or(0);
  }
  message.wall_seconds = outcome.wall_seconds;
  message.cpu_seconds = outcome.cpu_seconds;
  std::string bytes(sizeof message, '\0');
  std::memcpy(bytes.data(), &message, sizeof message);
  return bytes + outcome.end + outcome.error;
}

Outcome unpack(const std::string& bytes, std::size_t& job) {
  Message message;
  std::memcpy(&message, bytes.data(), sizeof message);
  job = message.job;
  Outcome outcome;
  outcome.end = bytes.substr(sizeof message, message.end_bytes);
  outcome.error = bytes.substr(sizeof message + message.end_bytes);
  for (std::size_t k = 0; k < number_names.size(); ++k) {
    if ((message.present >> k & 1U) != 0) outcome.numbers[k] = message.numbers[k];
  }
  outcome.wall_seconds = message.wall_seconds;
  outcome.cpu_seconds = message.cpu_seconds;
  return outcome;
}

void send(int rank, Tag tag, const std::string& bytes = {}) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

void send_job(int rank, std::size_t job) {
  std::string bytes(sizeof job, '\0');
  std::memcpy(bytes.data(), &job, sizeof job);
  send(rank, job_tag, bytes);
}

struct Received {
  int rank;
  int tag;
  std::string bytes;
};

/// The next message that is there, if any.
std::optional<Received> receive(int tag = MPI_ANY_TAG) {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Received received{status.MPI_SOURCE, status.MPI_TAG,
                    std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(received.bytes.data(), size, MPI_BYTE, received.rank, received.tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return received;
}

/// Rank 0: sends `end` to all others and takes what still comes in until all have said farewell.
void end_all(int ranks, const std::function<void(const Received&)>& take) {
  for (int rank = 1; rank < ranks; ++rank) send(rank, end_tag);
  for (int left = ranks - 1; left > 0;) {
    const auto received = receive();
    if (!received) {
      std::this_thread::sleep_for(pause);
    } else if (received->tag == farewell_tag) {
      --left;
    } else {
      take(*received);
    }
  }
}

/// What rank 0 knows of the others.
class Distributor {
 public:
  Distributor(Collector& collector, int ranks)
      : collector_{collector}, given_(static_cast<std::size_t>(ranks), 0) {}

  void run() {
    while (!is_over()) {
      hand_out();
      std::this_thread::sleep_for(pause_of_first);
      while (const auto received = receive()) take(*received);
      collector_.tick();
    }
  }

  void take(const Received& received) {
    if (received.tag == interrupted_tag) collector_.stop();
    if (received.tag != outcome_tag) return;
    std::size_t job = 0;
    Outcome outcome = unpack(received.bytes, job);
    ++outcomes_;
    --given_[static_cast<std::size_t>(received.rank)];
    seconds_ += outcome.wall_seconds;
    collector_.add(job, std::move(outcome));
  }

 private:
  [[nodiscard]] bool is_over() const {
    return collector_.stopped() || outcomes_ == collector_.open_jobs().size();
  }

  /// How many jobs a rank may have at a time: short ones are handed out ahead, so that nobody waits
  /// for the next message; of long ones nobody has a second while others have none.
  [[nodiscard]] std::size_t share() const {
    constexpr double seconds_ahead = 0.1;
    const auto jobs = static_cast<double>(outcomes_);
    if (outcomes_ == 0 || seconds_ > seconds_ahead * jobs) return 1;
    return 1 +
           static_cast<std::size_t>(std::min(1'023.0, seconds_ahead * jobs / (seconds_ + 1e-9)));
  }

  void hand_out() {
    const std::vector<std::size_t>& jobs = collector_.open_jobs();
    for (std::size_t rank = 1; rank < given_.size(); ++rank) {
      for (; next_ < jobs.size() && given_[rank] < share(); ++given_[rank]) {
        send_job(static_cast<int>(rank), jobs[next_++]);
      }
    }
  }

  Collector& collector_;
  std::vector<std::size_t> given_;  ///< by rank: jobs that it has
  std::size_t next_ = 0;
  std::size_t outcomes_ = 0;
  double seconds_ = 0;  ///< of all outcomes
};

}  // namespace

MpiWorld::MpiWorld() {
  MPI_Init(nullptr, nullptr);
  initialised_ = true;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  if (ranks_ != launch().ranks) {
    error_ =
        "started by the mpirun of another MPI than the one that this program was built with; "
        "use that one's";
  }
}

MpiWorld::~MpiWorld() {
  if (initialised_) MPI_Finalize();
}

bool MpiWorld::agree_on(const Plan& plan) const {
  const Digest own = plan.digest();
  Digest first = own;
  MPI_Bcast(first.data(), static_cast<int>(first.size()), MPI_BYTE, 0, MPI_COMM_WORLD);
  const int equal = first == own ? 1 : 0;
  int all = 0;
  MPI_Allreduce(&equal, &all, 1, MPI_INT, MPI_LAND, MPI_COMM_WORLD);
  return all != 0;
}

void MpiWorld::distribute(Collector& collector) const {
  Distributor distributor{collector, ranks_};
  distributor.run();
  collector.tick();  // commits what is there, because of a rank that died there is no farewell
  end_all(ranks_, [&](const Received& received) { distributor.take(received); });
  collector.finish();
}

void MpiWorld::dismiss() const {
  end_all(ranks_, [](const Received&) {});
}

void MpiWorld::work(const Plan& plan, const std::function<bool()>& interrupted) const {
  bool is_over = false;
  const auto stop = [&] {
    is_over = is_over || receive(end_tag).has_value();
    return is_over || interrupted();
  };
  while (!is_over) {
    const auto received = receive();
    if (!received) {
      std::this_thread::sleep_for(pause);
    } else if (received->tag == end_tag) {
      is_over = true;
    } else if (received->tag == job_tag) {
      std::size_t job = 0;
      std::memcpy(&job, received->bytes.data(), sizeof job);
      const std::optional<Outcome> outcome = run(plan.scenario(job), stop);
      if (outcome) {
        send(0, outcome_tag, pack(job, *outcome));
      } else {
        send(0, interrupted_tag);
      }
    }
  }
  while (receive(job_tag)) {  // given, but not begun
  }
  send(0, farewell_tag);
}

#endif

}  // namespace stormproof::sweep
