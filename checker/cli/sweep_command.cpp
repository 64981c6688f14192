// `stormproof sweep GRID -o FILE`: runs all scenarios of a grid, on all cores or under mpirun, and
// keeps the results in SQLite; goes on where it stopped.
#include <fmt/core.h>
#include <sys/resource.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/experiments/sweep/mpi_ranks.hpp"
#include "checker/experiments/sweep/sweep.hpp"
#include "checker/experiments/sweep/sweep_report.hpp"
#include "checker/experiments/sweep/tables.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using model::config::SpecPath;
using sweep::Collector;
using sweep::Plan;

struct SweepArguments {
  std::string grid;                 ///< file, or name of a shipped grid
  std::string database;             ///< SQLite file, made or continued
  std::vector<std::string> others;  ///< databases whose rows it takes over
  std::string shard;                ///< "K/N"; empty: the whole grid
  OutputFile csv, json;
  std::size_t threads = 0;  ///< 0: one for each core
};

/// Of the whole process, all threads.
double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// How long it took and what of it was simulation: a note, because it is never twice the same.
std::string times(const SweepArguments& arguments, const Collector& results, double seconds) {
  if (const int ranks = sweep::launch().ranks; ranks > 1) {
    return fmt::format("{:.2f} s on {} ranks; {:.2f} s of CPU in simulation", seconds, ranks,
                       results.cpu_seconds());
  }
  const double all = process_cpu_seconds();
  return fmt::format("{:.2f} s on {} threads; {:.2f} s of CPU, {} of it in simulation", seconds,
                     arguments.threads == 0 ? trials::core_count() : arguments.threads, all,
                     report::percent(results.cpu_seconds(), all));
}

/// Bar, rate and remaining time.
std::string progress_text(const sweep::Status& status, double seconds) {
  constexpr std::size_t width = 24;
  const std::size_t done = status.already_done + status.finished;
  const std::size_t marks = status.jobs == 0 ? width : done * width / status.jobs;
  const double rate = static_cast<double>(status.finished) / seconds;
  const std::string rest =
      rate > 0 ? fmt::format("{:.0f} s left", static_cast<double>(status.jobs - done) / rate)
               : "no job done yet";
  return fmt::format("[{:<{}}] {} of {} jobs, {:.3g} a second, {}", std::string(marks, '#'), width,
                     report::grouped(done), report::grouped(status.jobs), rate, rest);
}

/// The only process, or rank 0: runs the plan and reports. `world` is null without MPI.
Outcome lead(SweepArguments& arguments, const Plan& plan, const sweep::MpiWorld* world,
             Session& session) {
  const auto refuse = [&](Complaint complaint) {
    if (world != nullptr) world->dismiss();
    return complaint;
  };
  auto database = sweep::Database::open(arguments.database, STORMPROOF_VERSION);
  if (!database) return refuse(database.error());
  for (const std::string& other : arguments.others) {
    if (const auto error = database->take_over(other)) return refuse(*error);
  }
  Collector results{
      plan, *database, [&session](const sweep::Status& status) {
        return session.proceed([&] { return progress_text(status, session.seconds()); });
      }};
  if (world != nullptr) {
    world->distribute(results);
  } else {
    sweep::run_here(plan, arguments.threads, results);
  }
  if (arguments.csv.wanted()) sweep::write_csv(arguments.csv.stream(), plan, results);
  if (arguments.json.wanted()) {
    sweep::write_json(arguments.json.stream(), plan, results, STORMPROOF_VERSION);
  }
  Answer answer;
  answer.document = document_of(plan, results, arguments.database);
  answer.json = to_json(plan, results, arguments.database);
  if (results.status().finished > 0) {
    answer.notes.push_back(times(arguments, results, session.seconds()));
  }
  answer.complaint = results.error().value_or("");
  return answer;
}

/// One of several ranks.
Outcome take_part(SweepArguments& arguments, const Plan& plan, bool leads, Session& session) {
  const sweep::MpiWorld world;
  if (world.error()) return leads ? Outcome{Complaint{*world.error()}} : bad_input;
  if (!world.agree_on(plan)) {
    return leads ? Outcome{Complaint{arguments.grid +
                                     ": differs, or its profiles do, from one rank to another; "
                                     "expected the same files everywhere"}}
                 : bad_input;
  }
  if (leads) return lead(arguments, plan, &world, session);
  world.work(plan, [] { return Session::interrupted(); });
  return established;
}

bool is_leader() { return sweep::launch().rank == 0; }

/// "K/N"; the whole grid if nothing was said.
model::config::Result<grids::Shard> shard_of(const std::string& text) {
  if (text.empty()) return grids::Shard{};
  const std::size_t slash = text.find('/');
  const auto number = model::config::parse_count(text.substr(0, slash));
  const auto count =
      model::config::parse_count(slash == std::string::npos ? "" : text.substr(slash + 1));
  if (!number || !count || *number >= *count) {
    return model::config::InputError{
        "--shard " + text, "expected K/N: the number of this shard from 0, and how many there are"};
  }
  return grids::Shard{static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
}

Outcome run(SweepArguments& arguments, Session& session) {
  const bool leads = is_leader();
  const auto shard = shard_of(arguments.shard);
  if (!shard) return leads ? Outcome{shard.error()} : bad_input;
  if (shard->count > 1 && sweep::launch().ranks > 1) {
    const Complaint twice{"--shard " + arguments.shard +
                          ": the ranks of mpirun share the jobs already; expected one of the two"};
    return leads ? Outcome{twice} : bad_input;
  }
  const SpecPath specs = SpecPath::standard();
  auto grid = grids::read_grid(arguments.grid, specs);
  if (!grid) return leads ? Outcome{grid.error()} : bad_input;
  const auto plan = grids::make_plan(*std::move(grid), specs, *shard);
  if (!plan) return leads ? Outcome{plan.error()} : bad_input;
  return sweep::launch().ranks > 1 ? take_part(arguments, *plan, leads, session)
                                   : lead(arguments, *plan, nullptr, session);
}

void declare(Options& options, SweepArguments& arguments) {
  options.text("grid", arguments.grid, "Grid file, or name of a shipped grid", "GRID").required();
  options
      .written("-o,--output", arguments.database, "SQLite file of the results; made, or continued",
               "FILE")
      .required();
  options.texts("others", arguments.others,
                "Databases of other sweeps, such as shards, whose results are taken over first",
                "FILE...");
  options.text("--shard", arguments.shard,
               "Only shard K of N, with K from 0: every N-th job; for machines that share nothing",
               "K/N");
  options.output("--csv", arguments.csv, "Write the results as CSV");
  options.output("--json", arguments.json, "Write the results as JSON");
  options
      .number("--jobs", arguments.threads,
              "Jobs at a time (default: one for each core); under mpirun each rank runs one", "N")
      .within(1, 4'096);
}

}  // namespace

void declare_sweep(Frame& frame) {
  frame.add<SweepArguments>(
      {.name = "sweep",
       .help = "Run all scenarios of a grid and keep the results; go on where it stopped",
       .exit_codes =
           "Exit code: 0 all jobs complete discovery, 3 some do not or the sweep was interrupted,\n"
           "2 bad input.",
       .formats = Formats::pages,
       .schemas = {sweep::json_schema},
       .writes = is_leader},
      declare, run);
}

}  // namespace stormproof::cli
