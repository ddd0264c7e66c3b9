#include "distribution/boxTree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace clepsydra
{

namespace
{

constexpr int mostInLeaf = 8;

} // namespace

BoxTree::BoxTree(std::vector<Box> boxes)
    : boxes_(std::move(boxes)),
      order_(boxes_.size())
{
    std::iota(order_.begin(), order_.end(), 0);
    if (!boxes_.empty())
    {
        add(0, static_cast<int>(boxes_.size()));
    }
}

void BoxTree::add(int first, int end)
{
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    Box middles;
    for (int i = first; i < end; ++i)
    {
        const Box& box = boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
        nodes_[at].around.extend(box);
        middles.extend(box.center());
    }
    if (end - first <= mostInLeaf)
    {
        nodes_[at].first = first;
        nodes_[at].end = end;
    }
    else
    {
        Eigen::Index axis = 0;
        middles.sizes().maxCoeff(&axis);
        const int half = first + (end - first) / 2;
        const auto before = [&](int a, int b) {
            const double placeA = boxes_[static_cast<std::size_t>(a)].center()[axis];
            const double placeB = boxes_[static_cast<std::size_t>(b)].center()[axis];
            return placeA != placeB ? placeA < placeB : a < b;
        };
        std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + end, before);
        add(first, half);
        add(half, end);
    }
    nodes_[at].next = nodes_.size();
}

} // namespace clepsydra
