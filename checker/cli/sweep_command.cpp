// Reads the grid, continues the database, runs what is left, writes the tables, says how it went.
#include "checker/cli/sweep_command.hpp"

#include <filesystem>
#include <memory>
#include <set>

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/sweep/mpi_ranks.hpp"
#include "checker/experiments/sweep/sweep.hpp"
#include "checker/experiments/sweep/tables.hpp"
#include "checker/experiments/trials/parallel.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::cli {

namespace {

using model::config::SpecPath;
using sweep::Collector;
using sweep::Plan;

struct SweepArguments {
  std::string grid;              ///< file, or name of a shipped grid
  std::string database;          ///< SQLite file, made or continued
  std::string csv_file;          ///< empty: none
  std::string json_file;         ///< empty: none
  std::size_t threads = 0;       ///< 0: one for each core
  std::optional<bool> progress;  ///< not given: when stderr is a terminal
};

/// Bar, rate and remaining time of a sweep.
class SweepProgressLine {
 public:
  explicit SweepProgressLine(bool enabled) : line_{enabled} {}

  void update(const sweep::Status& status) {
    if (!line_.due()) return;
    constexpr std::size_t width = 24;
    const std::size_t done = status.already_done + status.finished;
    const std::size_t marks = status.jobs == 0 ? width : done * width / status.jobs;
    const double rate = static_cast<double>(status.finished) / line_.seconds();
    const std::string rest =
        rate > 0 ? fmt::format("{:.0f} s left", static_cast<double>(status.jobs - done) / rate)
                 : "no job done yet";
    line_.show(fmt::format("[{:<{}}] {} of {} jobs, {:.3g} a second, {}", std::string(marks, '#'),
                           width, report::grouped(done), report::grouped(status.jobs), rate, rest));
  }

 private:
  StatusLine line_;
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

struct Totals {
  std::size_t completed = 0;
  std::size_t incomplete = 0;
  std::size_t failed = 0;
  std::string first_error;
};

Totals count(const Plan& plan, const Collector& results) {
  Totals totals;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    const sweep::Outcome* outcome = results.outcome(job);
    if (outcome == nullptr) continue;
    if (outcome->failed() && totals.first_error.empty()) totals.first_error = outcome->error;
    ++(outcome->failed()      ? totals.failed
       : outcome->completed() ? totals.completed
                              : totals.incomplete);
  }
  return totals;
}

void print_summary(const SweepArguments& arguments, const Plan& plan, const Collector& results,
                   const Totals& totals) {
  const sweep::Status& status = results.status();
  const auto number = [](std::size_t value) { return report::grouped(value); };
  fmt::print("{}: {} of {} already done in {}, {} run now\n", plan.grid().source,
             number(status.already_done), number(status.jobs), arguments.database,
             number(status.finished));
  fmt::print("{} of {} complete discovery", number(totals.completed), number(status.jobs));
  if (totals.incomplete > 0)
    fmt::print(", {} incomplete when they ended", number(totals.incomplete));
  if (totals.failed > 0) fmt::print(", {} cannot run", number(totals.failed));
  const std::size_t open = status.jobs - totals.completed - totals.incomplete - totals.failed;
  if (open > 0) fmt::print(", {} left: the sweep was interrupted", number(open));
  fmt::print("\n");
  if (totals.failed > 0) fmt::print("first that cannot run: {}\n", totals.first_error);
}

/// What the model has not got of the systems in the plan: one line for each of their profiles.
void print_unmodelled(const Plan& plan) {
  std::set<std::string> lines;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    if (plan.first_alike(job) != job || plan.error(job)) continue;
    std::string line = report::unmodelled_line(plan.scenario(job).dds);
    if (!line.empty()) lines.insert(std::move(line));
  }
  for (const std::string& line : lines) fmt::print(stderr, "{}\n", line);
}

/// How long it took and what of it was simulation; to standard error, because it is never twice the
/// same.
void print_times(const SweepArguments& arguments, const Collector& results, double seconds,
                 int ranks) {
  if (results.status().finished == 0) return;
  if (ranks > 1) {
    fmt::print(stderr, "{:.2f} s on {} ranks; {:.2f} s of CPU in simulation\n", seconds, ranks,
               results.cpu_seconds());
    return;
  }
  const double all = process_cpu_seconds();
  fmt::print(stderr, "{:.2f} s on {} threads; {:.2f} s of CPU, {} of it in simulation\n", seconds,
             arguments.threads == 0 ? checker::core_count() : arguments.threads, all,
             report::percent(results.cpu_seconds(), all));
}

/// Writes the tables that were asked for; what went wrong, or nothing.
std::optional<std::string> write_tables(OutputFile& csv, OutputFile& json, const Plan& plan,
                                        const Collector& results) {
  if (csv.wanted()) sweep::write_csv(csv.stream(), plan, results);
  if (json.wanted()) sweep::write_json(json.stream(), plan, results, STORMPROOF_VERSION);
  if (auto error = csv.commit()) return error;
  return json.commit();
}

/// Whether two of the files are the same one; then one would replace the other.
bool same_file_twice(const SweepArguments& arguments) {
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code ignored;
    return !a.empty() && !b.empty() &&
           fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
  };
  return same(arguments.database, arguments.csv_file) ||
         same(arguments.database, arguments.json_file) ||
         (same(arguments.csv_file, arguments.json_file));
}

/// The only process, or rank 0: runs the plan and reports. `world` is null without MPI.
int lead(const SweepArguments& arguments, const Plan& plan, const sweep::MpiWorld* world) {
  const auto started = std::chrono::steady_clock::now();
  const auto refuse = [&](const std::string& message) {
    if (world != nullptr) world->dismiss();
    return complain(message);
  };
  if (same_file_twice(arguments)) return refuse("two outputs have the same file name");
  OutputFile csv{arguments.csv_file};
  OutputFile json{arguments.json_file};
  for (const OutputFile* file : {&csv, &json}) {
    if (const auto error = file->open_error()) return refuse(*error);
  }
  auto database = sweep::Database::open(arguments.database, STORMPROOF_VERSION);
  if (!database) return refuse(to_string(database.error()));

  std::optional<Collector> results;
  {
    const InterruptGuard guard;
    SweepProgressLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    results.emplace(plan, *database, [&line](const sweep::Status& status) {
      line.update(status);
      return !InterruptGuard::interrupted();
    });
    if (world != nullptr) {
      world->distribute(*results);
    } else {
      sweep::run_here(plan, arguments.threads, *results);
    }
  }
  const auto error = write_tables(csv, json, plan, *results);
  const Totals totals = count(plan, *results);
  print_summary(arguments, plan, *results, totals);
  print_unmodelled(plan);
  print_times(arguments, *results,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count(),
              sweep::launch().ranks);
  if (results->error()) return complain(*results->error());
  if (error) return complain(*error);
  return totals.completed == plan.size() ? established : inconclusive;
}

/// One of several ranks.
int take_part(const SweepArguments& arguments, const Plan& plan, bool leads) {
  const sweep::MpiWorld world;
  if (world.error()) return leads ? complain(*world.error()) : bad_input;
  if (!world.agree_on(plan)) {
    return leads ? complain(arguments.grid +
                            ": differs, or its profiles do, from one rank to "
                            "another; expected the same files everywhere")
                 : bad_input;
  }
  if (leads) return lead(arguments, plan, &world);
  const InterruptGuard guard;
  world.work(plan, [] { return InterruptGuard::interrupted(); });
  return established;
}

int sweep_grid(const SweepArguments& arguments) {
  const sweep::Launch launch = sweep::launch();
  const bool leads = launch.rank == 0;
  const SpecPath specs = SpecPath::standard();
  auto grid = sweep::read_grid(arguments.grid, specs);
  if (!grid) return leads ? complain(to_string(grid.error())) : bad_input;
  const auto plan = sweep::make_plan(*std::move(grid), specs);
  if (!plan) return leads ? complain(to_string(plan.error())) : bad_input;
  return launch.ranks > 1 ? take_part(arguments, *plan, leads) : lead(arguments, *plan, nullptr);
}

}  // namespace

void declare_sweep(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command = app.add_subcommand(
      "sweep", "Run all scenarios of a grid and keep the results; go on where it stopped");
  command->add_option("grid", arguments->grid, "Grid file, or name of a shipped grid")
      ->required()
      ->type_name("GRID");
  command
      ->add_option("-o,--output", arguments->database,
                   "SQLite file of the results; made, or continued")
      ->required()
      ->type_name("FILE");
  command->add_option("--csv", arguments->csv_file, "Write the results as CSV")->type_name("FILE");
  command->add_option("--json", arguments->json_file, "Write the results as JSON")
      ->type_name("FILE");
  command
      ->add_option("--jobs", arguments->threads,
                   "Jobs at a time (default: one for each core); under mpirun each rank runs one")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 all jobs complete discovery, 3 some do not or the sweep was interrupted,\n"
      "2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return sweep_grid(*arguments); }; });
}

}  // namespace stormproof::cli
