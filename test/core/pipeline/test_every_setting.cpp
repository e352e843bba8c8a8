#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
/// For each setting of visitOptions() a value that should change the result.
const std::map<std::string, std::string>& otherValues()
{
  static const std::map<std::string, std::string> values = {
      {"views", "row"},
      {"volume_rows", "0"},
      {"volume_columns", "2"},
      {"paper2017_parameters", "published"},
      {"initializer", "dis"},
      {"match_directions", "both"},
      {"cpm_levels", "1"},
      {"cpm_pyramid_ratio", "0.8"},
      {"cpm_grid_spacing_px", "5"},
      {"cpm_iterations", "1"},
      {"cpm_search_radius_px", "1"},
      {"cpm_max_displacement_px", "1"},
      {"cpm_subpixel", "false"},
      {"cpm_consistency_threshold_px", "0.02"},
      {"cpm_confidence_sigma_px", "0.05"},
      {"cpm_weigh_by_centre", "false"},
      {"cpm_border_px", "12"},
      {"feature_flow", "false"},
      {"filter_sigma_spatial_px", "3"},
      {"filter_sigma_range", "1"},
      {"filter_angular", "false"},
      {"filter_sigma_angular_views", "0.5"},
      {"filter_sigma_angular_range", "2"},
      {"filter_iterations", "1"},
      {"variational", "false"},
      {"variational_views", "adjacent"},
      {"variational_smoothness", "10"},
      {"variational_gradient_weight", "0.1"},
      {"variational_edge_kappa", "0"},
      {"variational_presmoothing_px", "2"},
      {"variational_warps", "1"},
      {"variational_sor_iterations", "3"},
      {"variational_sor_omega", "1"},
      {"multiview_preset", "quality"},
      {"multiview_label_step_px", "0.5"},
      {"multiview_small_change_penalty", "200"},
      {"multiview_large_change_penalty", "50"},
      {"multiview_visibility_passes", "0"},
      {"multiview_background_fusion", "false"},
      {"multiview_thin_structures", "true"},
      {"multiview_boundary_pixels", "false"},
      {"multiview_refinements", "0"},
      {"multiview_brightness_slope", "false"},
      {"multiview_refinement_smoothness", "5000"},
  };
  return values;
}

/// What does not change the disparity of this light field: it is for clouds, for video, for small regions of
/// wrong matches, or is the method itself.
bool isTestedElsewhere(const std::string& name)
{
  return name == "method" || name == "multiview_temporal" || name == "multiview_registration" ||
         name == "min_confidence" || name == "keep_filled" || name == "min_depth_m" ||
         name == "max_depth_m" || name == "cpm_min_region_seeds" || name.rfind("dense_", 0) == 0;
}

class EverySetting : public ::testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    testing::SceneSettings settings;
    settings.size = {128, 96};
    settings.positions = testing::gridPositions(5, 5);
    std::vector<testing::Surface> surfaces = testing::standardScene(settings.size);
    // A part of the background is blank, as walls are.
    surfaces.front().texture = [textured = surfaces.front().texture](double x, double y)
    { return x > BLANK_FROM_PX ? cv::Vec3f(128.0F, 128.0F, 128.0F) : textured(x, y); };
    scene_ = testing::renderScene(surfaces, settings).light_field;
  }

  cv::Mat disparity(const PipelineOptions& options)
  {
    return pipeline_.run(scene_, options, {}).estimate.disparity.clone();
  }

  void expectEachToMatter(Method method)
  {
    PipelineOptions defaults;
    defaults.method = method;
    const cv::Mat usual = disparity(defaults);
    for (const NamedOption& option : listOptions(defaults))
    {
      const bool of_multiview = option.name.rfind("multiview", 0) == 0;
      const bool of_both = option.name == "views";
      if (isTestedElsewhere(option.name) || (!of_both && of_multiview != (method == Method::Multiview)))
      {
        continue;
      }
      ASSERT_EQ(otherValues().count(option.name), 1U) << option.name << " has no other value in this test";
      PipelineOptions options = defaults;
      setOption(options, option.name, otherValues().at(option.name));
      EXPECT_GT(cv::norm(disparity(options), usual, cv::NORM_INF), 0.0)
          << option.name << " = " << otherValues().at(option.name) << " changes nothing";
    }
  }

  static constexpr double BLANK_FROM_PX = 50.0;
  static LightField scene_;
  Pipeline pipeline_{2};
};

LightField EverySetting::scene_;

TEST_F(EverySetting, OfMultiviewMatters)
{
  expectEachToMatter(Method::Multiview);
}

TEST_F(EverySetting, OfPaper2017Matters)
{
  expectEachToMatter(Method::Paper2017);
}

}  // namespace
}  // namespace light_field_depth
