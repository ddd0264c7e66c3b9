#pragma once

#include "engine/particles.h"

#include <vector>

namespace clepsydra
{

/// Finds the boxes near a point, among boxes of any sizes and at any places.
///
/// The boxes are halved again and again along the longest extent of their middles, so the tree's memory is in proportion
/// to the number of boxes. Bins of equal size would fill the box around all of them: three long arms of a mesh, or a few
/// small cells in a large tank, need far more bins than they have cells.
class BoxTree
{
public:
    BoxTree() = default;
    explicit BoxTree(std::vector<Box> boxes);

    /// Box with the given index.
    const Box& operator[](std::size_t index) const
    {
        return boxes_[index];
    }

    /// Box around all boxes; empty where there are none.
    Box around() const
    {
        return nodes_.empty() ? Box() : nodes_.front().around;
    }

    /// Calls `act` with the index of each box that the cube around a sphere meets (cubeMeets()), in no order.
    template<class Act>
    void forEachNear(const Vector3d& centre, double radius, const Act& act) const
    {
        for (std::size_t at = 0; at < nodes_.size();)
        {
            const Node& node = nodes_[at];
            const bool near = cubeMeets(node.around, centre, radius);
            for (int i = node.first; near && node.isLeaf() && i < node.end; ++i)
            {
                const int index = order_[static_cast<std::size_t>(i)];
                if (cubeMeets(boxes_[static_cast<std::size_t>(index)], centre, radius))
                {
                    act(index);
                }
            }
            at = near ? at + 1 : node.next;
        }
    }

private:
    /// Nodes are stored in the order in which a search visits them; a leaf's successor is `next`.
    struct Node
    {
        Box around;
        /// The boxes of a leaf in order_; none for an inner node.
        int first = 0;
        int end = 0;
        /// The node to visit where this one is left out with all below it.
        std::size_t next = 0;

        bool isLeaf() const
        {
            return end > first;
        }
    };

    void add(int first, int end);

    std::vector<Box> boxes_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

} // namespace clepsydra
