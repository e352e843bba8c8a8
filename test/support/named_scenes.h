#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_NAMED_SCENES_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_NAMED_SCENES_H

#include <functional>
#include <string>
#include <vector>

#include "support/synthetic_scene.h"

namespace light_field_depth::testing
{
/// A small light field that shows one difficulty, with exact truth.
struct NamedScene
{
  std::string name;
  std::vector<Surface> surfaces;
  SceneSettings settings;

  SyntheticLightField render() const { return renderScene(surfaces, settings); }
};

/// Bars one to four pixels wide in front of a textured wall; cross of 17 views.
NamedScene thinStructures();
/// Stripes with periods of 3 to 12 pixels at several depths; cross of 17 views.
NamedScene fineStripes();
/// Checkers and dots that repeat within the range of disparities; 3 x 3 views.
NamedScene repeatedTexture();
/// Floor, wall and roof with steep changes of disparity; cross of 17 views.
NamedScene slantedPlanes();
/// Surfaces that show nothing but smooth shading, behind textured ones; cross of 17 views.
NamedScene gradients();
/// A disc with a soft rim whose colour mixes with the wall's over several pixels; cross of 17 views.
NamedScene softEdges();
/// Disparities of 1 to 10 pixels between neighbours; 3 x 3 views.
NamedScene sparseArray();
/// The standard scene with Gaussian noise of 5 grey levels; cross of 17 views.
NamedScene noise();
/// The standard scene dark and noisy; cross of 17 views.
NamedScene darkAndNoisy();
/// Brightness that falls off towards the corners of each view, more in the outer views; cross of 17 views.
NamedScene vignetting();
/// Gain and offset that differ from view to view; cross of 17 views.
NamedScene exposureDifferences();
/// A surface whose brightness changes linearly with the position of the view; cross of 17 views.
NamedScene viewDependentBrightness();
/// A picket fence right in front that hides half of what is behind; cross of 17 views.
NamedScene strongOcclusion();
/// Many small squares at many depths; 5 x 5 views.
NamedScene clutter();
/// The standard scene seen by one row of five views.
NamedScene singleRow();

/// All of the above.
std::vector<NamedScene> namedScenes();

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_NAMED_SCENES_H
