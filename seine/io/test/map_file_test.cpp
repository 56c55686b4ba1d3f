#include "seine/io/map_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "seine/base/error.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;
const fs::path kMaps = fs::path(SEINE_DATA_DIR) / "maps";

constexpr const char* kGreyAlpha =
    "89504e470d0a1a0a0000000d4948445200000002000000020804000000d8bfc5af0000001049444154789c63f8ff9f01044ffc07"
    "001d7e05c4c4a9264d0000000049454e44ae426082";
constexpr const char* kRgb16 =
    "89504e470d0a1a0a0000000d49484452000000020000000110020000002bd0349e0000001049444154789c63f80f060c40f0ff3f"
    "003bd107f9bfca41490000000049454e44ae426082";
constexpr const char* kPalette =
    "89504e470d0a1a0a0000000d4948445200000003000000010203000000668efc2700000009504c5445ffffff0000001e3c5a90a4"
    "e6320000000467414d41000186a031e8965f0000000a49444154789c63900000001a00192d88f4360000000049454e44ae42608"
    "2";

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

/// What is said when a picture or a map is read; empty when nothing.
template <class Read>
std::string complaint_of(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Counted {
  const char* file;
  int width, height;
  long long blocked;   ///< cells that are not free
  long long checksum;  ///< Σ over blocked cells of (column + 1)(row from below + 1), mod 10⁹ + 7
};

// Counted by a separate script in another language, with its own PNG and PGM reader.
constexpr Counted kCounted[] = {
    {"ros/building_31.yaml", 693, 648, 18001, 815974622},
    {"ros/gdc_1.yaml", 1857, 1255, 1956274, 179588342},
    {"ros/gdc_2.yaml", 1800, 1400, 2047725, 136996126},
    {"ros/intel.yaml", 579, 581, 143451, 496480037},
    {"ros/levinelobby.yaml", 692, 836, 479600, 122583369},
    {"ros/skirk.yaml", 431, 602, 192879, 947842963},
    {"ros/stata_basement.yaml", 1730, 1300, 1938722, 621769727},
    {"ros/torino.yaml", 653, 712, 407429, 386752467},
    {"movingai/Berlin_1_256.map", 256, 256, 17996, 314784981},
    {"movingai/den312d.map", 65, 81, 2820, 4010198},
    {"movingai/warehouse-10-20-10-2-1.map", 161, 63, 4444, 11518848},
};

TEST(MapFile, CellsOfEveryMapMatchAnIndependentCount) {
  for (const Counted& known : kCounted) {
    const geom::OccupancyGrid grid = load_map(kMaps / known.file);
    EXPECT_EQ(grid.width, known.width) << known.file;
    EXPECT_EQ(grid.height, known.height) << known.file;
    long long blocked = 0, checksum = 0;
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        if (!grid.blocked(column, row)) continue;
        ++blocked;
        checksum = (checksum + static_cast<long long>(column + 1) * (row + 1)) % 1'000'000'007;
      }
    }
    EXPECT_EQ(blocked, known.blocked) << known.file;
    EXPECT_EQ(checksum, known.checksum) << known.file;
  }
}

TEST(MapFile, OriginAndYawAreTheHeaders) {
  const geom::OccupancyGrid grid = load_map(kMaps / "ros/stata_basement.yaml");
  EXPECT_EQ(grid.origin, (geom::Pose2{25.9, 48.5, 3.14}));
  EXPECT_EQ(grid.resolution, 0.0504);
}

TEST(MapFile, HeaderTakesOtherProgramsKeysAndRefusesNonsense) {
  const std::string good =
      "image: a.pgm\nresolution: 0.05\norigin: [1., -2, .5]\nnegate: 1\nmode: scale\nextra: 3\n\n";
  const MapHeader header = parse_map_header(good, "m.yaml");
  EXPECT_EQ(header.origin, (geom::Pose2{1, -2, 0.5}));
  EXPECT_TRUE(header.negate);
  const auto said = [](const std::string& text) {
    return complaint_of([&] { parse_map_header(text, "m.yaml"); });
  };
  EXPECT_EQ(said("image: a\norigin: [0, 0, 0]\n"),
            "m.yaml:1: the file has no 'resolution', which is required");
  EXPECT_EQ(said("image: a\nresolution: 0\norigin: [0, 0, 0]\n"),
            "m.yaml:2: 'resolution' is 0, expected from 1e-04 to 1000");
  EXPECT_EQ(said("image: a\nresolution: 1\norigin: [0, 0, 0]\nmode: raw\n"),
            "m.yaml:4: 'mode' is 'raw', expected trinary or scale");
}

TEST(MapFile, PgmInBothForms) {
  const std::string text = "P2 # made by hand\n#\n# size\n3 2 # levels\n4\n0 1 2\n3 4 4\n";
  const GreyImage a = decode_image(text, "a.pgm");
  EXPECT_EQ(a.shade, (std::vector<std::uint16_t>{0, 1, 2, 3, 4, 4}));
  EXPECT_EQ(a.white, 4);
  const std::string two_bytes = std::string("P5\n2 1\n65535\n") + std::string("\x01\x02\xff\xff", 4);
  EXPECT_EQ(decode_image(two_bytes, "a.pgm").shade, (std::vector<std::uint16_t>{258, 65535}));
  // The first row of a picture is the top row of the map; 2/4 is unknown, so an obstacle.
  const geom::OccupancyGrid grid =
      grid_from_image(a, MapHeader{.image = "", .origin = {}, .free_below = 0.25});
  EXPECT_EQ(grid.occupied, (std::vector<std::uint8_t>{1, 0, 0, 1, 1, 1}));
  const geom::OccupancyGrid negative =
      grid_from_image(a, MapHeader{.image = "", .origin = {}, .negate = true, .free_below = 0.26});
  EXPECT_EQ(negative.occupied, (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 1}));
}

TEST(MapFile, PngOfEveryColourType) {
  const GreyImage grey = decode_image(from_hex(kGreyAlpha), "a.png");
  EXPECT_EQ(grey.shade, (std::vector<std::uint16_t>{255, 0, 255, 200}));
  EXPECT_EQ(grey.transparent, (std::vector<std::uint8_t>{0, 0, 1, 0}));
  // Without colour means without knowledge.
  EXPECT_EQ(grid_from_image(grey, {}).occupied, (std::vector<std::uint8_t>{1, 1, 0, 1}));
  const GreyImage rgb = decode_image(from_hex(kRgb16), "a.png");
  EXPECT_EQ(rgb.white, 765);
  EXPECT_EQ(rgb.shade, (std::vector<std::uint16_t>{765, 255}));
  const GreyImage palette = decode_image(from_hex(kPalette), "a.png");
  EXPECT_EQ(palette.shade, (std::vector<std::uint16_t>{765, 0, 180}));
  const GreyImage mask = decode_image(encode_mask_png(3, 1, {0, 1, 1}, 0x102030), "a.png");
  EXPECT_EQ(mask.shade, (std::vector<std::uint16_t>{765, 96, 96}));
  EXPECT_EQ(mask.transparent, (std::vector<std::uint8_t>{1, 0, 0}));
}

TEST(MapFile, HostilePicturesAreRefused) {
  const auto said = [](const std::string& bytes) { return complaint_of([&] { decode_image(bytes, "a"); }); };
  EXPECT_EQ(said(""), "a: is no picture this program reads, expected PGM (P2 or P5) or PNG");
  EXPECT_EQ(said("P5\n1000000 1000000\n255\n"), "a:3: has too many pixels, expected at most 25 million");
  EXPECT_EQ(said("P5\n99999999999999999999 1\n255\n"), "a:2: has width 1000000000, expected 1 to 1000000");
  EXPECT_EQ(said("P5\n5000 5000\n255\nabc"), "a:3: ends after 3 of 25000000 pixels");
  EXPECT_EQ(said("P2\n5000 5000\n255\n1 2 3"), "a:3: is too short for its width and height");
  EXPECT_EQ(said("P2\n2 1\n255\n1 x\n"), "a:4: has no shade where a whole number was expected");
  EXPECT_EQ(said("P2\n2 1\n255\n1 256\n"), "a:4: has shade 256, expected 0 to 255");
  EXPECT_EQ(said("P5\n0 1\n255\n"), "a:2: has width 0, expected 1 to 1000000");
  const std::string png = from_hex(kRgb16);
  for (std::size_t length = 4; length + 12 < png.size(); ++length) EXPECT_NE(said(png.substr(0, length)), "");
  std::string huge = png;
  huge[18] = '\x0f';  // width 983042: the checksum no longer fits either
  EXPECT_NE(said(huge), "");
}

TEST(MapFile, SaveGivesBackTheSameGrid) {
  const fs::path folder = fs::temp_directory_path() / "seine-map-test";
  fs::create_directories(folder);
  const geom::OccupancyGrid grid{3, 2, 0.1, {1.0 / 3, -0.2, -3.1}, {0, 1, 0, 1, 1, 0}};
  save_map(grid, folder / "m.yaml");
  const geom::OccupancyGrid read = load_map(folder / "m.yaml");
  EXPECT_EQ(read.occupied, grid.occupied);
  EXPECT_EQ(read.origin, grid.origin);
  EXPECT_EQ(read.resolution, grid.resolution);
  fs::remove_all(folder);
}

TEST(MapFile, MovingAiMistakesAreNamed) {
  const auto said = [](const std::string& text) {
    return complaint_of([&] { parse_movingai(text, "a.map"); });
  };
  EXPECT_EQ(said("type octile\nheight 1\nwidth 2\nmap\n.@\n"), "");
  EXPECT_EQ(said("type octile\nheight 1\nwidth 2\nmap\n.\n\n"), "a.map:5: has 1 cells, expected 2");
  EXPECT_EQ(said("type octile\nheight 99999\nwidth 99999\nmap\n.\n"),
            "a.map:3: has too many cells, expected at most 25 million");
  EXPECT_EQ(said("type octile\nheight 4999\nwidth 4999\nmap\n.\n"),
            "a.map:5: is too short for its width and height");
  EXPECT_EQ(said("type octile\nheight x\n"),
            "a.map:2: is no MovingAI map, expected 'height' and 1 to 100000");
}

}  // namespace
}  // namespace seine::io
