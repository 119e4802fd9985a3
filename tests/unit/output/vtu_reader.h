// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_vtu_reader_h
#define perideal_tests_vtu_reader_h

#include <deal.II/base/utilities.h>

#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace output_test
{
  /// Contents of the compressed block of a VTK data array: base64 of four
  /// 64-bit numbers (blocks, block size, last block size, compressed size),
  /// then base64 of the zlib stream; three numbers where there is no block.
  inline std::string decode_data_array(const std::string &base64)
  {
    constexpr std::size_t header_length = 44;
    if (base64.size() < header_length)
      return {};
    const auto compressed = dealii::Utilities::decode_base64(base64.substr(header_length));

    boost::iostreams::filtering_istream in;
    in.push(boost::iostreams::zlib_decompressor());
    std::istringstream source(std::string(compressed.begin(), compressed.end()));
    in.push(source);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }

  /// Values of all data arrays whose tag contains @p attribute, one for every
  /// piece of the file.
  template <typename T>
  std::vector<std::vector<T>> read_data_arrays(const std::string &vtu, const std::string &attribute)
  {
    std::vector<std::vector<T>> result;
    for (auto tag = vtu.find("<DataArray"); tag != std::string::npos; tag = vtu.find("<DataArray", tag + 1))
      {
        const auto tag_end = vtu.find('>', tag);
        if (vtu.substr(tag, tag_end - tag).find(attribute) == std::string::npos)
          continue;
        const auto        begin = vtu.find_first_not_of(" \n", tag_end + 1);
        const auto        end   = vtu.find_first_of(" \n<", begin);
        const std::string bytes = decode_data_array(vtu.substr(begin, end - begin));
        std::vector<T>    values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        result.push_back(values);
      }
    return result;
  }
} // namespace output_test

#endif
