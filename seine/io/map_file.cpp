#include "seine/io/map_file.hpp"

#include "seine/geom/grid_check.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_formats.hpp"
#include "seine/io/yaml_reader.hpp"

namespace seine::io {
namespace {

constexpr std::size_t kHeaderBytes = std::size_t{1} << 20, kPictureBytes = std::size_t{64} << 20;
constexpr Range kProbability{0.0, 1.0};

bool read_flag(const YamlValue& value) {
  const std::string text = value.text();
  if (text == "0" || text == "false") return false;
  if (text == "1" || text == "true") return true;
  value.fail("is '" + text + "', expected 0 or 1");
}

geom::Pose2 read_origin(const YamlValue& value) {
  const std::size_t count = value.list(2, 3).size();
  const std::vector<YamlValue> xyh = value.list(count, count);
  return {xyh[0].number(kCoordinate), xyh[1].number(kCoordinate), count == 3 ? xyh[2].heading() : 0.0};
}

/// The next line of `text`, taken off it, without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

/// A header line "<key> <count>".
int read_count(std::string_view line, std::string_view key, const std::string& file, int number) {
  const bool named =
      line.substr(0, key.size()) == key && line.size() > key.size() + 1 && line[key.size()] == ' ';
  const std::optional<long long> count = named ? parse_integer(line.substr(key.size() + 1)) : std::nullopt;
  if (!count || *count < 1 || *count > 100000) {
    throw complaint(file, number, "is no MovingAI map, expected '" + std::string(key) + "' and 1 to 100000");
  }
  return static_cast<int>(*count);
}

}  // namespace

MapHeader parse_map_header(std::string_view text, const std::string& file) {
  // Keys of other programs may stand in it: this format is not ours.
  const YamlMap map = YamlValue::parse(with_line_ends(without_mark(text)), file).open_map();
  MapHeader header;
  header.image = map.at("image").text();
  header.image_line = map.at("image").line();
  header.resolution = map.at("resolution").number({1e-4, 1e3});
  header.origin = read_origin(map.at("origin"));
  if (const auto negate = map.find("negate")) header.negate = read_flag(*negate);
  header.occupied_above = map.number("occupied_thresh", kProbability, header.occupied_above);
  header.free_below = map.number("free_thresh", kProbability, header.free_below);
  if (const auto mode = map.find("mode")) {
    // Both call free what is below free_thresh; raw gives the shades another meaning.
    const std::string name = mode->text();
    if (name != "trinary" && name != "scale") mode->fail("is '" + name + "', expected trinary or scale");
  }
  return header;
}

geom::OccupancyGrid grid_from_image(const GreyImage& image, const MapHeader& header) {
  geom::OccupancyGrid grid{image.width, image.height, header.resolution, header.origin, {}};
  grid.occupied.resize(image.pixels());
  const std::size_t width = static_cast<std::size_t>(image.width),
                    height = static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const double dark = static_cast<double>(header.negate ? image.shade[i] : image.white - image.shade[i]);
    const double p = dark / static_cast<double>(image.white);
    const bool transparent = !image.transparent.empty() && image.transparent[i] != 0;
    const bool free = !transparent && p < header.free_below && !(p > header.occupied_above);
    grid.occupied[(height - 1 - i / width) * width + i % width] = free ? 0 : 1;
  }
  return grid;
}

geom::OccupancyGrid parse_movingai(std::string_view text, const std::string& file) {
  const std::string lines = with_line_ends(without_mark(text));
  text = lines;
  if (take_line(text).substr(0, 5) != "type ")
    throw complaint(file, 1, "is no MovingAI map, expected 'type octile'");
  geom::OccupancyGrid grid;
  grid.height = read_count(take_line(text), "height", file, 2);
  grid.width = read_count(take_line(text), "width", file, 3);
  if (static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height) > kMaxPixels)
    throw complaint(file, 3, "has too many cells, expected at most 25 million");
  if (take_line(text) != "map") throw complaint(file, 4, "is no MovingAI map, expected 'map'");
  grid.resolution = 1.0;
  const std::size_t width = static_cast<std::size_t>(grid.width),
                    height = static_cast<std::size_t>(grid.height);
  if (text.size() < width * height) throw complaint(file, 5, "is too short for its width and height");
  grid.occupied.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    const std::string_view line = take_line(text);
    if (line.size() != width) {
      throw complaint(file, static_cast<int>(row) + 5,
                      "has " + std::to_string(line.size()) + " cells, expected " + std::to_string(width));
    }
    for (std::size_t column = 0; column < width; ++column) {
      const char c = line[column];
      grid.occupied[(height - 1 - row) * width + column] = c == '.' || c == 'G' || c == 'S' ? 0 : 1;
    }
  }
  return grid;
}

geom::OccupancyGrid load_map(const std::filesystem::path& path, Reading* reading) {
  if (reading != nullptr) reading->add_file(path);
  if (path.extension() == ".map") return parse_movingai(read_file(path, kPictureBytes), path.string());
  const MapHeader header = parse_map_header(read_file(path, kHeaderBytes), path.string());
  const std::filesystem::path picture = path.parent_path() / header.image;
  if (const std::string why = why_unreadable(picture); !why.empty()) {
    throw complaint(path.string(), header.image_line,
                    joined("'image' is '", header.image, "', which cannot be read: ", why));
  }
  if (reading != nullptr) reading->add_file(picture);
  return grid_from_image(decode_image(read_file(picture, kPictureBytes), picture.string()), header);
}

void save_map(const geom::OccupancyGrid& grid, const std::filesystem::path& path) {
  if (!geom::is_complete(grid)) throw InputError("the map has not the cells that its width and height say");
  std::filesystem::path picture = path;
  picture.replace_extension(".pgm");
  std::string pixels = "P5\n" + std::to_string(grid.width) + " " + std::to_string(grid.height) + "\n255\n";
  for (int row = grid.height - 1; row >= 0; --row) {
    for (int column = 0; column < grid.width; ++column) pixels += grid.blocked(column, row) ? '\0' : '\xfe';
  }
  write_file(picture, pixels);
  write_file(path, "image: " + picture.filename().string() + "\nresolution: " + number_text(grid.resolution) +
                       "\norigin: [" + number_text(grid.origin.x) + ", " + number_text(grid.origin.y) + ", " +
                       number_text(grid.origin.heading) +
                       "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n");
}

}  // namespace seine::io
