// Follows Fast DDS's composition, of participants that nobody forgets.
#include "props/monitors/followed_fastdds.hpp"

namespace stormproof::props {

namespace {

class FastDdsFollower final : public FollowedFastDds<FastDdsFollower, fastdds::FastDds> {
 public:
  using FollowedFastDds::FollowedFastDds;
};

}  // namespace

std::unique_ptr<Follower> follow(model::Of<fastdds::FastDds>, const model::Scenario& scenario,
                                 const model::Topology& topology) {
  return std::make_unique<FastDdsFollower>(scenario, topology);
}

}  // namespace stormproof::props
