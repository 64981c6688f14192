// Records every composition once.
#include "fsm/program/programs.hpp"

#include "fsm/composition/amended.hpp"
#include "fsm/composition/cyclone_life.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/fastdds_life.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/server_life.hpp"
#include "fsm/program/record.hpp"

namespace stormproof::fsm::program {

const std::vector<Program>& programs() {
  static const std::vector<Program> all{recorded<composition::paper::Paper>(),
                                        recorded<composition::fastdds::FastDds>(),
                                        recorded<composition::cyclone::Cyclone>(),
                                        recorded<composition::server::FastDdsServer>(),
                                        recorded<composition::amended::Amended>(),
                                        recorded<composition::fastdds::FastDdsLiving>(),
                                        recorded<composition::cyclone::CycloneLiving>(),
                                        recorded<composition::server::FastDdsServerLiving>()};
  return all;
}

}  // namespace stormproof::fsm::program
