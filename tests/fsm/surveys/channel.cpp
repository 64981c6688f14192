// Inputs of the channel: all there are.
#include "fsm/channel.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_channel() {
  return survey<Channel>({{false, false}, {false, true}, {true, false}, {true, true}});
}

}  // namespace stormproof::fsm
