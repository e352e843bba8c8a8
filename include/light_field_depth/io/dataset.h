#ifndef LIGHT_FIELD_DEPTH_IO_DATASET_H
#define LIGHT_FIELD_DEPTH_IO_DATASET_H

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
/// Whether the numbering of a dataset's rows or columns runs against the convention (rows downwards, columns
/// to the right). Flipping turns the order round, so that positive disparities are nearer again.
enum class Flip
{
  None,
  Rows,
  Columns,
  Both
};

/// "none", "rows", "columns", "both".
std::string toString(Flip flip);
/// The inverse of toString(). @throw InputError that lists the names.
Flip flipFromString(const std::string& name);

/// Which of a view's two numbers is the row. A single number counts along the rows, or down the columns.
enum class Order
{
  RowMajor,    ///< the first number is the row
  ColumnMajor  ///< the first number is the column
};

/// "row-major", "column-major".
std::string toString(Order order);
/// The inverse of toString(). @throw InputError that lists the names.
Order orderFromString(const std::string& name);

/// The value of an option --order: empty for "" and "auto". @throw InputError that lists the names.
std::optional<Order> orderOption(const std::string& name);
/// The value of an option --flip: empty for "" and "auto". @throw InputError that lists the names.
std::optional<Flip> flipOption(const std::string& name);

/// "ROWSxCOLUMNS", as in "9x17"; cv::Size has the columns as its width.
/// @param option the name for messages @throw InputError
cv::Size gridFromString(const std::string& option, const std::string& text);

/// How much a dataset's claim of where its views stand is worth.
enum class PlaceClaim
{
  Stated,       ///< by a description or by camera positions
  TwoNumbers,   ///< by names with a row and a column: which is which and which way they run is usage
  SingleNumber  ///< by names with one number: the shape of the grid is a guess as well
};

/// "stated", "two numbers", "single number".
std::string toString(PlaceClaim claim);

/// What is known of the cameras besides what the dataset states; it wins over that.
struct CameraOptions
{
  std::optional<double> focal_length_px;  ///< of the rectified views
  std::optional<cv::Point2d> baseline_m;  ///< between adjacent columns and between adjacent rows; positive
  std::optional<cv::Point2d> principal_point_px;  ///< of the dataset's own reference view
  std::optional<double> focus_distance_m;  ///< of the plane of zero disparity; parallel cameras if absent
};

/// What the order and the flip of a dataset come from.
enum class LayoutSource
{
  Option,       ///< at least one of the two
  Description,  ///< light_field.yaml, a toolbox's own file, or camera positions
  Images,       ///< found from the images, which agree with the names or overrule them
  Names         ///< the usual meaning of the names; the images did not tell
};

/// "option", "description", "images", "names".
std::string toString(LayoutSource source);

/// How a folder is read.
struct DatasetOptions
{
  /// Numbered as in the dataset's files, the row first; the middle view when absent.
  std::optional<GridPosition> reference;
  std::optional<Order> order;     ///< what the dataset's own description says when absent
  std::optional<Flip> flip;       ///< what the dataset's own description says when absent
  std::optional<cv::Size> grid;   ///< columns x rows of the views that one number names
  std::optional<cv::Size> tiles;  ///< columns x rows of the views in one image
  std::optional<std::string>
      frame;             ///< of a sequence: its number, or its folder's name; the first when absent
  CameraOptions camera;  ///< wins over what the dataset states
  /// Which views to decode, chosen from the light field without images; all when empty.
  std::function<ViewSelection(const LightField& without_images)> selection;
  /// Is told how many views are to be decoded and one of them, before the others are, but for some that the
  /// layout is found from; may throw. Empty: all are welcome.
  std::function<void(std::size_t views, const cv::Mat& one)> admit;
  double max_megapixels = InputLimits().megapixels;  ///< of an image file; with more it is refused
  bool mask_black = false;  ///< what is black up to the border of a view shows nothing of the scene
  int threads = 0;          ///< that decode images; 0 takes one per processor
};

/// A light field read from a folder.
struct Dataset
{
  /// View::grid has the files' numbers, reversed where rows or columns are flipped. View::steps follow the
  /// numbers also where views are missing in between: disparities are always per step of the numbering.
  LightField light_field;
  std::string format;                                ///< "yaml", "hci", "grid", "index", ...: docs/formats.md
  PlaceClaim place_claim = PlaceClaim::Stated;       ///< before options and images were asked
  Order order = Order::RowMajor;                     ///< that was applied
  Flip flip = Flip::None;                            ///< that was applied
  LayoutSource layout_source = LayoutSource::Names;  ///< of both
  std::size_t views_found = 0;               ///< in the folder; DatasetOptions::selection may leave some out
  std::vector<std::filesystem::path> files;  ///< of LightField::views, in their order
  std::optional<DisparityRange> disparity_range;  ///< as the dataset's description states it, in px per step
  std::optional<std::filesystem::path> truth;     ///< a PFM with the disparity of the reference view
  std::vector<std::string> frames;    ///< names of a sequence's frames; empty for a single light field
  std::vector<std::string> notes;     ///< sentences on what was left out, guessed or converted
  std::vector<std::string> warnings;  ///< sentences on what may make the result wrong
};

/// The frame of a sequence that has a name, or a number at the end of its name. @throw InputError
std::size_t frameIndex(const std::vector<std::string>& names, const std::string& wanted);

/// Recognises the format of a folder by its files (docs/formats.md has the list) and reads its views, in
/// parallel. A file is a light field of tiles or lenslets. What is not named like a view is left out with a
/// note. The stated range and the truth are dropped where another reference view or layout makes them wrong.
/// @throw InputError that names the folder or the file, what is wrong with it and the remedy
Dataset readDataset(const std::filesystem::path& folder, const DatasetOptions& options = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_IO_DATASET_H
