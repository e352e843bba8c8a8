#include "ablation.h"

#include <memory>

#include <nlohmann/json.hpp>

#include "contestant.h"

namespace light_field_depth::benchmark
{
namespace
{
/// The first is what the others are compared with. A new ingredient joins with one line.
const std::vector<Variant>& variants()
{
  static const std::vector<Variant> all = {
      {"balanced", {}},
      {"no visibility pass", {"multiview_visibility_passes=0"}},
      {"two visibility passes", {"multiview_visibility_passes=2"}},
      {"textureless regions left where they are", {"multiview_background_fusion=false"}},
      {"thin structures not kept", {"multiview_thin_structures=false"}},
      {"edge pixels not decided by colour", {"multiview_edge_sides=false"}},
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

std::string accuracyText(const Evaluation& accuracy)
{
  return fixed(accuracy.mse_100, 3) + " / " + fixed(accuracy.badpix_007, 2) + " / " +
         fixed(accuracy.badpix_003, 1);
}

}  // namespace

void ablate(const Settings& settings)
{
  Table table;
  table.header = {"variant"};
  nlohmann::ordered_json json = describeMachine(settings);
  const auto pipeline = std::make_shared<Pipeline>(settings.threads);
  std::vector<Contestant> contestants;
  for (const Variant& variant : variants())
  {
    contestants.push_back(makeContestant(variant, pipeline));
    table.rows.push_back({variant.name});
  }
  for (const std::string& input : settings.inputs)
  {
    const Scene scene = readScene(input, settings.threads);
    table.header.push_back(scene.name + ": MSE x 100 / BadPix 0.07 / 0.03 %");
    table.header.emplace_back("ms");
    const std::vector<Result> results = measure(scene, contestants, settings.runs);
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      table.rows[i].push_back(accuracyText(results[i].evaluation));
      table.rows[i].push_back(fixed(results[i].timing.median(), 0));
      nlohmann::ordered_json row;
      row["scene"] = scene.name;
      row["variant"] = results[i].name;
      row["settings"] = variants()[i].settings;
      row["time"] = toJson(results[i].timing);
      row["accuracy"] = accuracyJson(results[i]);
      json["rows"].push_back(row);
    }
  }
  publish(settings, "ablation", table, json);
}

}  // namespace light_field_depth::benchmark
