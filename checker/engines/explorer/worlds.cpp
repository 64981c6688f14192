// The worlds that are explored, compiled once.
#include "checker/engines/explorer/fastdds_packing.hpp"
#include "checker/engines/explorer/paper_packing.hpp"

namespace stormproof::explorer {

template class RelationWorld<PaperPacking>;
template class RelationWorld<FastDdsPacking>;
template class RelationWorld<PaperPacking, 2>;
template class RelationWorld<FastDdsPacking, 2>;
template class RelationWorld<PaperPacking, most_readers>;
template class RelationWorld<FastDdsPacking, most_readers>;
template class RelationWorld<PaperPacking, 1, most_writers>;
template class RelationWorld<FastDdsPacking, 1, most_writers>;

}  // namespace stormproof::explorer
