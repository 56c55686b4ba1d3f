#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace seine::sim {

/// Writes an MCAP file [MCAP]: messages on channels, in uncompressed chunks with an index, so that readers
/// can jump to any time. Goes forward only: any stream will do. Checksums are left out, as the format allows.
class McapWriter {
 public:
  /// @param out must outlive this
  explicit McapWriter(std::ostream& out);

  /// A kind of message, described as JSON Schema; returns its number.
  std::uint16_t add_schema(std::string_view name, std::string_view json_schema);
  /// A named stream of JSON messages of that kind; returns its number.
  std::uint16_t add_channel(std::string_view topic, std::uint16_t schema);
  /// @param time ns, never before that of the message before
  void write(std::uint16_t channel, std::uint64_t time, std::string_view json);
  /// Ends the file. Nothing may be written afterwards.
  void close();

 private:
  struct ChunkPlace {
    std::uint64_t first, last;  // ns
    std::uint64_t start, length;
    std::map<std::uint16_t, std::uint64_t> indexes;  // where the message index of a channel stands
    std::uint64_t indexes_length;
    std::uint64_t size;
  };
  struct Entry {
    std::uint64_t time, offset;
  };
  void flush_chunk();
  void put(const std::string& bytes);
  void put_summary();
  std::uint64_t put_group(std::uint8_t opcode, const std::vector<std::string>& records, std::string& offsets);

  std::ostream& out_;
  std::uint64_t position_ = 0;
  std::vector<std::string> schemas_, channels_;  // whole records
  std::string chunk_;                            // records of the chunk being filled
  std::map<std::uint16_t, std::vector<Entry>> entries_;
  std::uint64_t chunk_first_ = 0, last_ = 0, first_ = 0;
  std::vector<ChunkPlace> chunks_;
  std::map<std::uint16_t, std::uint64_t> counts_;  // messages on a channel
  std::uint64_t messages_ = 0;
};

}  // namespace seine::sim
