// Where objects pierce each other.
#pragma once

#include "facets.hpp"

namespace thermedge::sim {

// Adds the curves along which facets of different objects, or the round end and the side of one,
// cut each other: flat with flat, flat with ball, flat with tube, ball with ball, and ball with a
// tube whose axis runs through its centre. Two that only touch have their outline already.
// Not covered: tubes that pierce tubes, and balls beside a tube's axis.
void add_intersections(Facets& world);

}  // namespace thermedge::sim
