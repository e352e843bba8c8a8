// Light fields as they should not be: each gives a right answer or one sentence, in bounded memory and time.

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/dataset.h"
#include "support/sanitizers.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;
using testing::TemporaryFolder;

constexpr int WIDTH_PX = 48;
constexpr int HEIGHT_PX = 40;
/// Of the plane that all views show.
constexpr int DISPARITY_PX = 1;
constexpr rlim_t MOST_MEMORY_BYTES = rlim_t{2} << 30U;
constexpr rlim_t MOST_SECONDS = 20;

enum class Wanted
{
  Answer,    ///< the disparity of the plane
  Sentence,  ///< an InputError
  Either     ///< one of them; of a scene without parallax any finite map will do
};

cv::Mat texture(int type = CV_8UC3)
{
  cv::Mat image(HEIGHT_PX + 32, WIDTH_PX + 32, type);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0.0, CV_MAT_DEPTH(type) == CV_8U ? 255.0 : 4000.0);
  return image;
}

/// What the camera in a row and column sees.
cv::Mat view(int row, int column, int type = CV_8UC3)
{
  return texture(type)(cv::Rect(16 + DISPARITY_PX * column, 16 + DISPARITY_PX * row, WIDTH_PX, HEIGHT_PX));
}

std::string nameOf(int row, int column)
{
  return "view_" + std::to_string(row) + "_" + std::to_string(column) + ".png";
}

/// A folder of 3 x 3 views, and how it is read and solved.
struct Scene
{
  TemporaryFolder folder;
  fs::path input = folder / "scene";
  DatasetOptions dataset;
  PipelineOptions pipeline;

  Scene()
  {
    fs::create_directories(input);
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        put(nameOf(row, column), view(row, column));
      }
    }
    dataset.threads = 1;
  }

  void put(const std::string& name, const cv::Mat& image) const
  {
    cv::imwrite((input / name).string(), image);
  }
  void write(const std::string& name, const std::string& content) const
  {
    folder.write("scene/" + name, content);
  }
  void yaml(const std::string& content) const { write("light_field.yaml", content); }
  /// light_field.yaml with three views of the upper row at these positions.
  void positions(const std::string& a, const std::string& b, const std::string& c,
                 const std::string& more = "") const
  {
    yaml("views:\n  - {file: view_0_0.png, row: 0, column: 0, position_m: " + a +
         "}\n  - {file: view_0_1.png, row: 0, column: 1, position_m: " + b +
         "}\n  - {file: view_0_2.png, row: 0, column: 2, position_m: " + c + "}\n" + more);
  }
  void clear() const
  {
    fs::remove_all(input);
    fs::create_directories(input);
  }
  void cut(const std::string& name, double part) const
  {
    fs::resize_file(input / name,
                    static_cast<std::uintmax_t>(part * static_cast<double>(fs::file_size(input / name))));
  }
  /// Overwrites bytes in the middle of a file.
  void damage(const std::string& name) const
  {
    std::FILE* const file = std::fopen((input / name).c_str(), "r+b");
    std::fseek(file, static_cast<long>(fs::file_size(input / name) / 2), SEEK_SET);
    std::fputs("\xFF\xC4 this is not what was here before", file);
    std::fclose(file);
  }
};

struct Case
{
  const char* name;
  Wanted wanted;
  std::function<void(Scene&)> make;
};

void PrintTo(const Case& which, std::ostream* stream)
{
  *stream << which.name;
}

const char* const GRID = "pattern: 'view_{row}_{column}.png'\ngrid: {rows: 3, columns: 3}\n";

/// Views written as floats or in a format of their own.
void convert(const Scene& scene, const std::string& extension, int type, double scale)
{
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      fs::remove(scene.input / nameOf(row, column));
      cv::Mat image;
      view(row, column).convertTo(image, type, scale);
      scene.put(fs::path(nameOf(row, column)).stem().string() + extension, image);
    }
  }
}

// clang-format off
const std::vector<Case> CASES = {
    {"AsItShouldBe", Wanted::Answer, [](Scene&) {}},
    // ------------------------------------------------------------------------------ files and folders
    {"NoFolder", Wanted::Sentence, [](Scene& s) { s.input = s.folder / "absent"; }},
    {"EmptyFolder", Wanted::Sentence, [](Scene& s) { s.clear(); }},
    {"EmptyName", Wanted::Sentence, [](Scene& s) { s.input = ""; }},
    {"TextAsFolder", Wanted::Sentence, [](Scene& s) { s.input = s.folder.write("text.txt", "text"); }},
    {"DeviceAsFolder", Wanted::Sentence, [](Scene& s) { s.input = "/dev/zero"; }},
    {"NameTooLong", Wanted::Sentence, [](Scene& s) { s.input = s.folder / std::string(300, 'n'); }},
    {"PathTooLong", Wanted::Sentence, [](Scene& s) { s.input = std::string(5000, '/') + "x"; }},
    {"FolderInACircle", Wanted::Sentence, [](Scene& s) { s.input = s.folder / "circle"; fs::create_symlink("circle", s.input); }},
    {"LinkToTheFolder", Wanted::Answer, [](Scene& s) { fs::create_directory_symlink(s.input, s.folder / "link"); s.input = s.folder / "link"; }},
    {"OneView", Wanted::Sentence, [](Scene& s) { s.clear(); s.put("view_0_0.png", view(0, 0)); }},
    {"HiddenFilesOnly", Wanted::Sentence, [](Scene& s) { s.clear(); s.write(".view_0_0.png", "x"); }},
    {"EmptyImage", Wanted::Sentence, [](Scene& s) { s.write("view_1_1.png", ""); }},
    {"TruncatedPng", Wanted::Sentence, [](Scene& s) { s.cut("view_1_2.png", 0.6); }},
    {"DamagedPng", Wanted::Sentence, [](Scene& s) { s.damage("view_1_2.png"); }},
    {"GarbageAsPng", Wanted::Sentence, [](Scene& s) { s.write("view_0_1.png", std::string(500, 'g')); }},
    {"WebPageAsPng", Wanted::Sentence, [](Scene& s) { s.write("view_0_1.png", "<html>404 not found</html>"); }},
    {"TruncatedJpeg", Wanted::Sentence, [](Scene& s) { convert(s, ".jpg", CV_8U, 1.0); s.cut("view_0_1.jpg", 0.5); }},
    {"JpegDamagedInItsMiddle", Wanted::Sentence, [](Scene& s) { convert(s, ".jpg", CV_8U, 1.0); s.damage("view_0_1.jpg"); }},
    {"JpegPictures", Wanted::Answer, [](Scene& s) { convert(s, ".jpg", CV_8U, 1.0); }},
    {"HeaderThatLies", Wanted::Sentence, [](Scene& s) { s.clear(); for (const char* name : {"v_0.pgm", "v_1.pgm"}) s.write(name, "P5\n60000 60000\n255\nabc"); }},
    {"DanglingLink", Wanted::Either, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); fs::create_symlink("absent", s.input / "view_0_0.png"); }},
    {"CircularLink", Wanted::Either, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); fs::create_symlink("view_0_0.png", s.input / "view_0_0.png"); }},
    {"PipeAsView", Wanted::Either, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); mkfifo((s.input / "view_0_0.png").c_str(), 0600); }},
    {"DeviceAsView", Wanted::Either, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); fs::create_symlink("/dev/zero", s.input / "view_0_0.png"); }},
    {"FolderAsView", Wanted::Either, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); fs::create_directory(s.input / "view_0_0.png"); }},
    // ------------------------------------------------------------------------------ sizes and types
    {"OtherSize", Wanted::Sentence, [](Scene& s) { s.put("view_0_1.png", texture()); }},
    {"GreyAmongColour", Wanted::Answer, [](Scene& s) { s.put("view_0_1.png", view(0, 1, CV_8UC1)); }},
    {"SixteenBitsAmongEight", Wanted::Sentence, [](Scene& s) { s.put("view_0_1.png", view(0, 1, CV_16UC3)); }},
    {"AlphaIsDropped", Wanted::Answer, [](Scene& s) { cv::Mat bgra; std::vector<cv::Mat> c; cv::split(view(0, 1), c); c.push_back(c[0]); cv::merge(c, bgra); s.put("view_0_1.png", bgra); }},
    {"OnePixel", Wanted::Sentence, [](Scene& s) { for (int r = 0; r < 3; ++r) for (int c = 0; c < 3; ++c) s.put(nameOf(r, c), view(r, c)(cv::Rect(0, 0, 1, 1))); }},
    {"FifteenPixels", Wanted::Sentence, [](Scene& s) { for (int r = 0; r < 3; ++r) for (int c = 0; c < 3; ++c) s.put(nameOf(r, c), view(r, c)(cv::Rect(0, 0, 15, 15))); }},
    {"SixteenPixels", Wanted::Either, [](Scene& s) { for (int r = 0; r < 3; ++r) for (int c = 0; c < 3; ++c) s.put(nameOf(r, c), view(r, c)(cv::Rect(0, 0, 16, 16))); }},
    {"OneRow", Wanted::Sentence, [](Scene& s) { for (int r = 0; r < 3; ++r) for (int c = 0; c < 3; ++c) s.put(nameOf(r, c), view(r, c).row(0)); }},
    {"FloatTiff", Wanted::Either, [](Scene& s) { convert(s, ".tiff", CV_32F, 1.0 / 255.0); }},
    {"FloatOfNaN", Wanted::Either, [](Scene& s) { convert(s, ".exr", CV_32F, std::nan("")); }},
    {"FloatOfInfinity", Wanted::Either, [](Scene& s) { convert(s, ".exr", CV_32F, INFINITY); }},
    {"FloatOfHugeValues", Wanted::Either, [](Scene& s) { convert(s, ".exr", CV_32F, 1e36); }},
    {"IntegerTiff", Wanted::Sentence, [](Scene& s) { convert(s, ".tiff", CV_32S, 1.0); }},
    {"DoubleTiff", Wanted::Sentence, [](Scene& s) { convert(s, ".tiff", CV_64F, 1.0); }},
    {"SixteenBits", Wanted::Answer, [](Scene& s) { convert(s, ".png", CV_16U, 257.0); }},
    // ------------------------------------------------------------------------------ names
    {"MiddleMissing", Wanted::Answer, [](Scene& s) { fs::remove(s.input / "view_1_1.png"); }},
    {"CornerMissing", Wanted::Answer, [](Scene& s) { fs::remove(s.input / "view_0_0.png"); }},
    {"SameNumberTwice", Wanted::Either, [](Scene& s) { s.put("view_0_0.jpg", view(0, 0)); }},
    {"SameNumberInOtherDigits", Wanted::Sentence, [](Scene& s) { s.put("view_0_00.png", view(0, 0)); }},
    {"TwoDatasets", Wanted::Either, [](Scene& s) { for (int i = 0; i < 9; ++i) s.put("other" + std::to_string(i) + ".png", view(i / 3, i % 3)); }},
    {"NegativeNumbers", Wanted::Answer, [](Scene& s) { s.clear(); for (int c = -1; c < 2; ++c) s.put("view_00_" + std::to_string(c) + ".png", view(0, c)); }},
    {"NumbersFromAThousand", Wanted::Answer, [](Scene& s) { s.clear(); for (int c = 1000; c < 1003; ++c) s.put("view_00_" + std::to_string(c) + ".png", view(0, c - 1000)); }},
    {"NumberTooLarge", Wanted::Either, [](Scene& s) { s.clear(); for (const char* n : {"v_1.png", "v_99999999999999999999.png"}) s.put(n, view(0, 0)); }},
    {"NumbersFarApart", Wanted::Either, [](Scene& s) { s.put("view_0_99999.png", view(0, 2)); }},
    {"SpacesAndQuotes", Wanted::Answer, [](Scene& s) { s.clear(); for (int c = 0; c < 3; ++c) s.put("a 'view' \"of\" ünïcode " + std::to_string(c) + ".png", view(0, c)); }},
    {"LineBreakInAName", Wanted::Answer, [](Scene& s) { s.clear(); for (int c = 0; c < 3; ++c) s.put("line\nbreak_" + std::to_string(c) + ".png", view(0, c)); }},
    {"LongNames", Wanted::Answer, [](Scene& s) { s.clear(); for (int c = 0; c < 3; ++c) s.put(std::string(240, 'v') + std::to_string(c) + ".png", view(0, c)); }},
    {"NoNumbers", Wanted::Sentence, [](Scene& s) { s.clear(); for (const char* n : {"a.png", "b.png", "c.png"}) s.put(n, view(0, 0)); }},
    // ------------------------------------------------------------------------------ scenes
    {"AllBlack", Wanted::Either, [](Scene& s) { for (int i = 0; i < 9; ++i) s.put(nameOf(i / 3, i % 3), cv::Mat::zeros(HEIGHT_PX, WIDTH_PX, CV_8UC3)); }},
    {"AllWhite", Wanted::Either, [](Scene& s) { for (int i = 0; i < 9; ++i) s.put(nameOf(i / 3, i % 3), cv::Mat(HEIGHT_PX, WIDTH_PX, CV_8UC3, cv::Scalar::all(255))); }},
    {"NoParallax", Wanted::Either, [](Scene& s) { for (int i = 0; i < 9; ++i) s.put(nameOf(i / 3, i % 3), view(0, 0)); }},
    {"NoiseInEachView", Wanted::Either, [](Scene& s) { for (int i = 0; i < 9; ++i) { cv::Mat noise(HEIGHT_PX, WIDTH_PX, CV_8UC3); cv::RNG(static_cast<unsigned>(i)).fill(noise, cv::RNG::UNIFORM, 0, 255); s.put(nameOf(i / 3, i % 3), noise); } }},
    {"OneViewBlack", Wanted::Either, [](Scene& s) { s.put("view_0_0.png", cv::Mat::zeros(HEIGHT_PX, WIDTH_PX, CV_8UC3)); }},
    // ------------------------------------------------------------------------------ light_field.yaml
    {"YamlAsItShouldBe", Wanted::Answer, [](Scene& s) { s.yaml(GRID); }},
    {"YamlEmpty", Wanted::Sentence, [](Scene& s) { s.yaml(""); }},
    {"YamlBinary", Wanted::Sentence, [](Scene& s) { s.yaml(std::string("\0\xFF\xFE\x01", 4)); }},
    {"YamlList", Wanted::Sentence, [](Scene& s) { s.yaml("- 1\n- 2\n"); }},
    {"YamlBroken", Wanted::Sentence, [](Scene& s) { s.yaml("grid: {rows: 3"); }},
    {"YamlUnknownField", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "focal: 3\n"); }},
    {"YamlDeep", Wanted::Sentence, [](Scene& s) { s.yaml("views: " + std::string(20000, '[')); }},
    {"YamlAliases", Wanted::Sentence, [](Scene& s) { s.yaml("a: &a [x,x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a,*a]\nc: &c [*b,*b,*b,*b,*b,*b,*b,*b,*b]\nd: &d [*c,*c,*c,*c,*c,*c,*c,*c]\nviews: [*d,*d,*d,*d,*d,*d,*d]\n"); }},
    {"YamlCircle", Wanted::Sentence, [](Scene& s) { s.yaml("views: &v [*v]\n"); }},
    {"YamlPipe", Wanted::Sentence, [](Scene& s) { mkfifo((s.input / "light_field.yaml").c_str(), 0600); }},
    {"YamlLinkInACircle", Wanted::Sentence, [](Scene& s) { fs::create_symlink("light_field.yaml", s.input / "light_field.yaml"); }},
    {"YamlDevice", Wanted::Sentence, [](Scene& s) { fs::create_symlink("/dev/zero", s.input / "light_field.yaml"); }},
    {"YamlFolder", Wanted::Sentence, [](Scene& s) { fs::create_directory(s.input / "light_field.yaml"); }},
    {"NoViews", Wanted::Sentence, [](Scene& s) { s.yaml("views: []\n"); }},
    {"ViewsAreANumber", Wanted::Sentence, [](Scene& s) { s.yaml("views: 5\n"); }},
    {"ViewsOfNumbers", Wanted::Sentence, [](Scene& s) { s.yaml("views: [1, 2, 3]\n"); }},
    {"ViewWithoutFile", Wanted::Sentence, [](Scene& s) { s.yaml("views: [{row: 0, column: 0}, {row: 0, column: 1}]\n"); }},
    {"ViewOfAnAbsentFile", Wanted::Sentence, [](Scene& s) { s.yaml("views: [{file: a.png, row: 0, column: 0}, {file: view_0_1.png, row: 0, column: 1}]\n"); }},
    {"ViewsOnOnePlace", Wanted::Sentence, [](Scene& s) { s.yaml("views: [{file: view_0_0.png, row: 0, column: 0}, {file: view_0_1.png, row: 0, column: 0}]\n"); }},
    {"PositionNoNumber", Wanted::Sentence, [](Scene& s) { s.positions("[0, 0]", "[.nan, 0]", "[2, 0]"); }},
    {"PositionInfinite", Wanted::Sentence, [](Scene& s) { s.positions("[0, 0]", "[1, 0]", "[.inf, 0]"); }},
    {"PositionText", Wanted::Sentence, [](Scene& s) { s.positions("[0, 0]", "[left, 0]", "[2, 0]"); }},
    {"PositionOfOneNumber", Wanted::Sentence, [](Scene& s) { s.positions("[0, 0]", "[1]", "[2, 0]"); }},
    {"PositionsEqual", Wanted::Sentence, [](Scene& s) { s.positions("[1, 1]", "[1, 1]", "[1, 1]"); }},
    {"PositionsNearlyEqual", Wanted::Sentence, [](Scene& s) { s.positions("[-1e-8, 0]", "[0, 0]", "[1, 0]"); s.pipeline.disparity_range = DisparityRange{-2e9F, 2e9F}; }},
    {"PositionsAMillionTimesApart", Wanted::Either, [](Scene& s) { s.positions("[0, 0]", "[1e-6, 0]", "[1, 0]"); }},
    {"PositionsAThousandTimesApart", Wanted::Either, [](Scene& s) { s.positions("[0, 0]", "[1, 0]", "[999, 0]"); s.pipeline.disparity_range = DisparityRange{-400, 400}; }},
    {"PositionsBeyondReason", Wanted::Either, [](Scene& s) { s.positions("[0, 0]", "[1, 0]", "[1e300, 0]"); }},
    {"PositionsTiny", Wanted::Either, [](Scene& s) { s.positions("[0, 0]", "[1e-300, 0]", "[2e-300, 0]"); }},
    {"GridOfNoRows", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view_{row}_{column}.png'\ngrid: {rows: 0, columns: 3}\n"); }},
    {"GridNegative", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view_{row}_{column}.png'\ngrid: {rows: -3, columns: 3}\n"); }},
    {"GridHuge", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view_{row}_{column}.png'\ngrid: {rows: 1000000000, columns: 1000000000}\n"); }},
    {"GridOfHalves", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view_{row}_{column}.png'\ngrid: {rows: 1.5, columns: 3}\n"); }},
    {"PatternWithoutPlaces", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view.png'\ngrid: {rows: 3, columns: 3}\n"); }},
    {"PatternOfAbsentFiles", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'no_{row}_{column}.png'\ngrid: {rows: 3, columns: 3}\n"); }},
    {"PatternWithAWideNumber", Wanted::Sentence, [](Scene& s) { s.yaml("pattern: 'view_{row:0999999999}_{column}.png'\ngrid: {rows: 3, columns: 3}\n"); }},
    {"FocalLengthZero", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "focal_length_px: 0\nbaseline_m: 0.1\n"); }},
    {"FocalLengthNoNumber", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "focal_length_px: .nan\nbaseline_m: 0.1\n"); }},
    {"BaselineNegative", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "focal_length_px: 100\nbaseline_m: -0.1\n"); }},
    {"FocusDistanceZero", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "focal_length_px: 100\nbaseline_m: 0.1\nfocus_distance_m: 0\n"); }},
    {"RangeReversed", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "disparity_range: [3, -3]\n"); }},
    {"RangeNoNumber", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "disparity_range: [.nan, 3]\n"); }},
    {"RangeOfThree", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "disparity_range: [1, 2, 3]\n"); }},
    {"FlipUnknown", Wanted::Sentence, [](Scene& s) { s.yaml(std::string(GRID) + "flip: sideways\n"); }},
    // ------------------------------------------------------------------------------ other descriptions
    {"ParametersGarbage", Wanted::Either, [](Scene& s) { s.write("parameters.cfg", "\xFF\x01 garbage"); }},
    {"ParametersWithoutCameras", Wanted::Either, [](Scene& s) { s.write("parameters.cfg", "[extrinsics]\nnum_cams_x = 0\nnum_cams_y = 0\n"); }},
    {"ParametersWithTooManyCameras", Wanted::Either, [](Scene& s) { s.write("parameters.cfg", "[extrinsics]\nnum_cams_x = 1000000000\nnum_cams_y = 1000000000\nbaseline_mm = nan\n"); }},
    {"TransformsGarbage", Wanted::Either, [](Scene& s) { s.write("transforms.json", "{"); }},
    {"TransformsEmpty", Wanted::Either, [](Scene& s) { s.write("transforms.json", "{\"frames\": []}"); }},
    {"TransformsOfText", Wanted::Either, [](Scene& s) { s.write("transforms.json", "{\"frames\": [{\"file_path\": \"view_0_0.png\", \"transform_matrix\": \"no\"}]}"); }},
    {"TransformsSingular", Wanted::Either, [](Scene& s) { s.write("transforms.json", "{\"fl_x\": 40, \"w\": 48, \"h\": 40, \"frames\": [{\"file_path\": \"view_0_0.png\", \"transform_matrix\": [[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}, {\"file_path\": \"view_0_1.png\", \"transform_matrix\": [[0,0,0,1e300],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}]}"); }},
    {"ColmapGarbage", Wanted::Either, [](Scene& s) { s.write("cameras.txt", "1 PINHOLE x y"); s.write("images.txt", "1 2 3"); }},
    {"PairWithGarbage", Wanted::Either, [](Scene& s) { s.clear(); s.put("im0.png", view(0, 0)); s.put("im1.png", view(0, 1)); s.write("calib.txt", "cam0=[nan nan; ; ]\nbaseline=\n"); }},
    // ------------------------------------------------------------------------------ options
    {"RangeBeyondTheImages", Wanted::Sentence, [](Scene& s) { s.pipeline.disparity_range = DisparityRange{-1000, 1000}; }},
    {"RangeOfNothing", Wanted::Sentence, [](Scene& s) { s.pipeline.disparity_range = DisparityRange{1, 1}; }},
    {"RangeInfinite", Wanted::Sentence, [](Scene& s) { s.pipeline.disparity_range = DisparityRange{-1, INFINITY}; }},
    {"RangeNarrow", Wanted::Answer, [](Scene& s) { s.pipeline.disparity_range = DisparityRange{0.999F, 1.001F}; }},
    {"ReferenceAbsent", Wanted::Sentence, [](Scene& s) { s.dataset.reference = GridPosition{7, 7}; }},
    {"GridOfAnotherSize", Wanted::Either, [](Scene& s) { s.dataset.grid = cv::Size(5, 5); }},
    {"TilesThatDoNotFit", Wanted::Either, [](Scene& s) { s.dataset.tiles = cv::Size(7, 1000); }},
    {"FrameAbsent", Wanted::Sentence, [](Scene& s) { s.dataset.frame = "17"; }},
    {"SelectionOfOneView", Wanted::Sentence, [](Scene& s) { s.clear(); for (int c = 0; c < 3; ++c) s.put(nameOf(0, c), view(0, c)); s.pipeline.views = ViewSelection::Column; }},
};
// clang-format on

enum ExitCode
{
  ANSWERED = 0,
  SAID = 1,
  WRONG_ANSWER = 3,
  OTHER_EXCEPTION = 4
};

/// Of the child: what it says goes through the pipe.
int solve(const Scene& scene, Wanted wanted, int pipe)
{
  const auto say = [&](const std::string& text) { return write(pipe, text.data(), text.size()) >= 0; };
  try
  {
    const Dataset dataset = readDataset(scene.input, scene.dataset);
    const PipelineResult result = Pipeline(1).run(dataset.light_field, scene.pipeline, {});
    const cv::Mat& disparity = result.estimate.disparity;
    std::vector<float> values(disparity.begin<float>(), disparity.end<float>());
    if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    {
      say("not finite");
      return WRONG_ANSWER;
    }
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    const float median = values[values.size() / 2];
    if (wanted == Wanted::Answer && std::abs(median - DISPARITY_PX) > 0.25F)
    {
      say("the median is " + std::to_string(median));
      return WRONG_ANSWER;
    }
    return ANSWERED;
  }
  catch (const InputError& error)
  {
    say(error.what());
    return SAID;
  }
  catch (const std::exception& error)
  {
    say(error.what());
    return OTHER_EXCEPTION;
  }
}

class BadLightFields : public ::testing::TestWithParam<Case>
{
};

TEST_P(BadLightFields, GiveARightAnswerOrOneSentence)
{
  cv::setNumThreads(1);  // none that a child would miss
  Scene scene;
  GetParam().make(scene);
  int ends[2] = {};
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    if (testing::CAN_LIMIT_ADDRESS_SPACE)
    {
      const rlimit memory = {MOST_MEMORY_BYTES, MOST_MEMORY_BYTES};
      setrlimit(RLIMIT_AS, &memory);
    }
    const rlimit time = {MOST_SECONDS, MOST_SECONDS};
    setrlimit(RLIMIT_CPU, &time);
    alarm(10 * MOST_SECONDS);  // whoever waits uses no processor
    _exit(solve(scene, GetParam().wanted, ends[1]));
  }
  close(ends[1]);
  std::string said;
  char letter = 0;
  while (read(ends[0], &letter, 1) == 1)
  {
    said += letter;
  }
  close(ends[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  const int code = WEXITSTATUS(status);
  switch (GetParam().wanted)
  {
    case Wanted::Answer:
      EXPECT_EQ(code, ANSWERED) << said;
      break;
    case Wanted::Sentence:
      EXPECT_EQ(code, SAID) << said;
      break;
    case Wanted::Either:
      EXPECT_TRUE(code == ANSWERED || code == SAID) << code << ": " << said;
      break;
  }
  if (code == SAID)
  {
    EXPECT_GT(said.size(), 30U) << said;
    EXPECT_EQ(said.back(), '.') << said;
    for (const char* const raw : {"filesystem error", "cv::", "std::", "OpenCV", "what()", "yaml-cpp"})
    {
      EXPECT_EQ(said.find(raw), std::string::npos) << said;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BadLightFields, ::testing::ValuesIn(CASES),
                         [](const auto& which) { return std::string(which.param.name); });

}  // namespace
}  // namespace light_field_depth
