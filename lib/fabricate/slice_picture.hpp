#pragma once
// Slices drawn for people: each point in the mean colour of its droplets (pattern/phase_colours.hpp), a legend, scale
// bars.

#include "animation/canvas.hpp"
#include "fabricate/droplet_plan.hpp"

namespace nacre::fabricate {

/// A rectangle of a specimen's slice in mm, from its left and its far edge.
struct SliceRectangle {
  double left_mm = 0.0, top_mm = 0.0, width_mm = 0.0, height_mm = 0.0;
};

/// All of a plan's slice.
SliceRectangle whole_of(const DropletPlan& plan);

/// The part of a slice of the plan, at `points_per_mm`, with its upper left corner at (left, top) of the picture.
void draw_slice(animation::Picture& picture, const DropletPlan& plan, const Slice& slice, const SliceRectangle& part,
                int left, int top, double points_per_mm);

inline constexpr double kLegendWidth = 170.0, kLegendHeight = 96.0;
/// The colours of droplets, downwards from the upper left corner.
void draw_legend(animation::Canvas& canvas, double left, double top);

/// A bar of that length from its left end, the length under it, 30 points high.
void draw_scale_bar(animation::Canvas& canvas, double left, double top, double length_mm, double points_per_mm);

}  // namespace nacre::fabricate
