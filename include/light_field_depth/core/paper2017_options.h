#ifndef LIGHT_FIELD_DEPTH_CORE_PAPER2017_OPTIONS_H
#define LIGHT_FIELD_DEPTH_CORE_PAPER2017_OPTIONS_H

#include <string>
#include <vector>

namespace light_field_depth
{
/// Which volumes to extract.
struct AngularVolumeOptions
{
  /// Numbers of the grid rows to use, separated by commas or spaces. Empty: what the view selection says.
  /// Name several to have more estimates to fuse.
  std::string rows;
  /// The same for grid columns.
  std::string columns;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const AngularVolumeOptions& options);

/// Coarse-to-fine PatchMatch along the epipolar line (paper, 3.2.1). The values of the paper are the
/// defaults.
struct PatchMatchOptions
{
  /// Levels of the pyramid, k in the paper. Fewer are used for images too small for that many.
  int levels = 5;
  /// Size of a level over that of the level below it, eta in the paper.
  double pyramid_ratio = 0.5;
  /// Distance of the seeds in pixels. Smaller is slower and follows finer structures.
  int grid_spacing_px = 3;
  /// Most sweeps of propagation and random search on a level; a level that has settled ends earlier.
  int iterations = 6;
  /// First radius of the random search in pixels of the level; it is halved down to 1.
  int search_radius_px = 4;
  /// Largest displacement for one grid step, in pixels, when no disparity range is given. Raise it for scenes
  /// with more; lower it where repeated texture leads astray.
  double max_displacement_px = 40.0;
  /// Fits the minimum of the cost between whole pixels. The paper has whole pixels only.
  bool subpixel = true;
  /// A match is dropped when going there and back ends further from the start than this, in pixels.
  double consistency_threshold_px = 1.0;
  /// Standard deviation, in pixels, of the disagreement of forward and backward matches that weighs a match
  /// by exp(-e^2 / (2 s^2)). Lower it to trust only matches that agree.
  double confidence_sigma_px = 0.4;
  /// Multiplies the weight of a match by DescriptorImage::centreShare(). Descriptors reach 4 px; next to an
  /// object the background matches the object's edge, and this is what keeps its disparity from spreading.
  /// The paper does not have it.
  bool weigh_by_centre = true;
  /// Matches of a connected region of fewer seeds than this, or than a twentieth of all, are dropped. Lower
  /// it for scenes with small parts; raise it where flat areas show spots.
  int min_region_seeds = 50;
  /// Matches that end closer than this to the border of the image are dropped, in pixels.
  int border_px = 2;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const PatchMatchOptions& options);

/// Feature flow (paper, 3.2.2; Lang et al., 2012). The scales are those of the paper where nothing else is
/// said.
struct FeatureFlowOptions
{
  /// false: the paper's ablation. Each pixel takes the nearest match of its view; nothing is filtered.
  bool enabled = true;
  /// sigma_s of the spatial filter in pixels. Lower it to let a match reach less far.
  double sigma_spatial_px = 2000.0;
  /// sigma_r of the spatial filter, of the sum of three colour channels in 0..1. The paper has 0.4, which
  /// lets disparity bleed across every edge of less than about 30 grey levels. Raise it for noisy views.
  double sigma_range = 0.1;
  /// Whether the filter runs along the angular axis as well.
  bool angular = true;
  /// sigma_s of the angular filter in views.
  double sigma_angular_views = 5.0;
  /// sigma_r of the angular filter, of the sum of three colour channels in 0..1.
  double sigma_angular_range = 0.1;
  /// Rounds of filtering x, y and the angular axis.
  int iterations = 3;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const FeatureFlowOptions& options);

/// Which views the refinement compares with the reference view.
enum class RefinementViews
{
  All,       ///< every view of the volumes
  Adjacent,  ///< the nearest on each side of the reference view
  Outermost  ///< the furthest on each side
};

/// "all", "adjacent", "outermost".
std::string toString(RefinementViews views);
/// The inverse of toString(). @throw InputError that lists the names.
RefinementViews refinementViewsFromString(const std::string& name);

/// The one-step variational refinement of EpicFlow (paper, 3.3.1), reduced to disparity.
struct VariationalOptions
{
  bool enabled = true;                           ///< false: the paper's ablation
  RefinementViews views = RefinementViews::All;  ///< that are compared with the reference
  /// Weight of the smoothness. Raise it for noisy views.
  double smoothness = 1.0;
  /// Weight of the gradient constancy.
  double gradient_weight = 0.71;
  /// Smoothness falls by exp(-kappa |grad I|) at edges of the image, I in 0..1.
  double edge_kappa = 5.0;
  /// Standard deviation of the Gaussian that smooths the views first, in pixels. EpicFlow has 1; less keeps
  /// disparity edges closer to the edges of the image. Raise it for noisy views.
  double presmoothing_px = 0.7;
  /// How often the views are warped again.
  int warps = 5;
  /// Sweeps of successive over-relaxation for each warp.
  int sor_iterations = 30;
  /// Over-relaxation, in (0, 2).
  double sor_omega = 1.9;
};

/// One whole sentence for each field that cannot be used.
std::vector<std::string> validate(const VariationalOptions& options);

/// What finds the first matches between neighbouring views.
enum class FlowInitializer
{
  Cpm,       ///< coarse-to-fine PatchMatch, the paper's choice
  Dis,       ///< OpenCV's dense inverse search, for comparison, like all that follow
  EpicFlow,  ///< Cpm, spread by OpenCV's edge-aware interpolation; needs OpenCV's module ximgproc
  DeepFlow,  ///< OpenCV's; needs its module optflow
  PcaFlow    ///< likewise
};

/// "cpm", "dis", "epicflow", "deepflow", "pcaflow".
std::string toString(FlowInitializer initializer);
/// The inverse of toString(). @throw InputError that lists the names.
FlowInitializer flowInitializerFromString(const std::string& name);

/// Which matches of a view are diffused.
enum class MatchDirections
{
  Forward,  ///< those to the next view of the volume, as in the paper
  Both      ///< those to both neighbours: what one hides from a view, the other may show
};

/// "forward", "both".
std::string toString(MatchDirections directions);
/// The inverse of toString(). @throw InputError that lists the names.
MatchDirections matchDirectionsFromString(const std::string& name);

/// Whose numbers the method of 2017 takes.
enum class Paper2017Parameters
{
  Tuned,     ///< the fields as they are
  Published  ///< withPublishedParameters()
};

/// "tuned", "published".
std::string toString(Paper2017Parameters parameters);
/// The inverse of toString(). @throw InputError that lists the names.
Paper2017Parameters paper2017ParametersFromString(const std::string& name);

/// Settings of the method of Chen, Alain and Smolic (2017).
struct Paper2017Options
{
  /// Published sets a group of the following to what the text of the paper states, to run what it describes.
  Paper2017Parameters parameters = Paper2017Parameters::Tuned;
  AngularVolumeOptions volumes;                                 ///< which rows and columns
  FlowInitializer initializer = FlowInitializer::Cpm;           ///< what finds the first matches
  MatchDirections match_directions = MatchDirections::Forward;  ///< which of them are diffused
  PatchMatchOptions patch_match;                                ///< for FlowInitializer::Cpm
  FeatureFlowOptions feature_flow;                              ///< how matches spread
  VariationalOptions variational;                               ///< the last step
};

std::vector<std::string> validate(const Paper2017Options& options);

/// The numbers of the paper (section 4) in place of the options' own, and without what it does not have:
/// 5 levels of half the size, seeds 3 pixels apart, matches of whole pixels, weighed by their consistency
/// alone, none dropped with its region; filters of 2000 px / 0.4 in space and 5 views / 0.1 over the angle;
/// kappa 5, and the views smoothed as in EpicFlow.
Paper2017Options withPublishedParameters(const Paper2017Options& options);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_PAPER2017_OPTIONS_H
