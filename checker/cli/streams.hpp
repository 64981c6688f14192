// Standard output and standard error, when nobody may be there: a closed descriptor, a pipe without
// a reader, a full disk. What cannot be printed on standard output makes the exit code `bad_input`;
// standard error is a courtesy, whose loss never ends or changes anything.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace stormproof::cli {

/// First of all, once. Descriptors 0 to 2 that are closed are taken, so that no file of ours gets
/// their numbers; writing to them fails. A closed pipe and a file size limit become errors of
/// writing instead of signals that end the program.
void prepare_streams();

/// On standard output. Whether it arrived is known in the end.
void print(std::string_view text);

/// On standard error, as it is.
void mutter(std::string_view text);

/// A line on standard error.
void say(const std::string& line);

/// While it lives, what would be printed or said is kept here instead: the answer of a command to a
/// program that this one is a part of. One at a time.
class Diversion {
 public:
  Diversion();
  ~Diversion();
  Diversion(const Diversion&) = delete;
  Diversion& operator=(const Diversion&) = delete;

  std::string printed{};
  std::string said{};
};

/// Empties standard output. If something of it was lost, the reason; that is empty if whoever read
/// it has gone (a pipe to `head`), who need not be told.
[[nodiscard]] std::optional<std::string> output_lost();

}  // namespace stormproof::cli
