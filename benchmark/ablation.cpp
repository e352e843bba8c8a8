#include "ablation.h"

#include <memory>

#include "accuracy_table.h"
#include "contestant.h"
#include "scene.h"

namespace light_field_depth::benchmark
{
const std::vector<Variant>& ablationVariants()
{
  static const std::vector<Variant> all = {
      {"balanced", {}},
      {"no visibility pass", {"multiview_visibility_passes=0"}},
      {"two visibility passes", {"multiview_visibility_passes=2"}},
      {"textureless regions left where they are", {"multiview_background_fusion=false"}},
      {"thin structures kept", {"multiview_thin_structures=true"}},
      {"edge pixels not decided by colour", {"multiview_boundary_pixels=false"}},
      {"no refinement", {"multiview_refinements=0"}},
      {"one refinement", {"multiview_refinements=1"}},
      {"four refinements", {"multiview_refinements=4"}},
      {"no brightness slope in the refinement", {"multiview_brightness_slope=false"}},
      {"refinement half as smooth", {"multiview_refinement_smoothness=100"}},
      {"refinement twice as smooth", {"multiview_refinement_smoothness=400"}},
      {"labels 1/4 px apart", {"multiview_label_step_px=0.25"}},
      {"labels 1/16 px apart", {"multiview_label_step_px=0.0625"}},
      {"P1 20", {"multiview_small_change_penalty=20"}},
      {"P1 45", {"multiview_small_change_penalty=45"}},
      {"P2 600", {"multiview_large_change_penalty=600"}},
      {"P2 1500", {"multiview_large_change_penalty=1500"}},
      {"the row of views alone", {"views=row"}},
      {"cross and diagonals", {"views=star"}},
      {"grey search, one refinement (`realtime`)", {"multiview_preset=realtime"}},
      {"half resolution in grey (`fast`)", {"multiview_preset=fast"}},
      {"colour, four refinements (`quality`)", {"multiview_preset=quality"}},
  };
  return all;
}

namespace
{
std::vector<std::string> namesOf(const std::vector<Variant>& all)
{
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Variant& variant : all)
  {
    names.push_back(variant.name);
  }
  return names;
}

}  // namespace

void ablate(const Settings& settings)
{
  AccuracyTable table(settings, "variant", namesOf(ablationVariants()));
  const auto pipeline = std::make_shared<Pipeline>(settings.threads);
  std::vector<Contestant> contestants;
  for (const Variant& variant : ablationVariants())
  {
    contestants.push_back(makeContestant(variant, pipeline));
  }
  for (const std::string& input : settings.inputs)
  {
    const Scene scene = readScene(input, settings.threads);
    table.add(scene.name, measure(scene, contestants, settings.runs));
  }
  table.publish("ablation");
}

}  // namespace light_field_depth::benchmark
