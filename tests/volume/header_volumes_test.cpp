// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD, MetaImage and VTK's ImageData in all forms that Slicer, ITK, VTK and pynrrd write.
#include <gtest/gtest.h>
#include <lz4.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/holds.h"
#include "support/volume_folder.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::array;
using test::channel;
using test::frame;
using test::MadeVolume;

class HeaderVolumes : public test::VolumeFolder {
 protected:
  std::string nrrd(const std::string& fields, const std::string& type = "ushort") const {
    return "NRRD0005\ntype: " + type + "\ndimension: 3\nsizes: " + made_.size_text() +
           "\nendian: little\n" + fields;
  }
  static std::string sizes(const std::vector<int>& counts) {
    std::string text;
    for (const int count : counts) text += " " + std::to_string(count);
    return "dimension: " + std::to_string(counts.size()) + "\nsizes:" + text + "\n";
  }
  std::string meta(const std::string& fields, const std::string& type = "MET_USHORT") const {
    return "ObjectType = Image\nNDims = 3\nDimSize = " + made_.size_text() +
           "\nElementType = " + type + "\n" + fields;
  }
  /// Slices as files of their own.
  void write_slices(const std::string& before, const std::string& after, int first, int step,
                    int digits) const {
    const std::string bytes = made_.bytes<std::uint16_t>();
    for (std::size_t z = 0; z < 3; ++z) {
      std::string number = std::to_string(first + static_cast<int>(z) * step);
      while (number.size() < static_cast<std::size_t>(digits)) number.insert(0, 1, '0');
      write(before + number + after, bytes.substr(z * bytes.size() / 3, bytes.size() / 3));
    }
  }
  std::string text() const {
    std::string all;
    for (std::size_t k = 0; k < made_.labels.size(); ++k) {
      all += std::to_string(made_.labels[k]) + (k % 7 == 6 ? "\n" : " ");
    }
    return all;
  }
  /// Volumes one beside the other: of each voxel `count` numbers, or one volume after the other.
  template <class Value>
  std::string mixed(int count, bool beside) const {
    std::string all;
    const std::size_t voxels = made_.labels.size();
    for (std::size_t k = 0; k < voxels * static_cast<std::size_t>(count); ++k) {
      const auto which = beside ? k % static_cast<std::size_t>(count) : k / voxels;
      const std::size_t voxel = beside ? k / static_cast<std::size_t>(count) : k % voxels;
      const auto value = static_cast<Value>(made_.labels[voxel] + 200 * which);
      all.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return all;
  }
};

TEST_F(HeaderVolumes, ReadsNrrdInManyFiles) {
  write_slices("s_", ".raw", 1, 1, 3);
  expect_made_of("a.nhdr",
                 nrrd("encoding: raw\ndata file: LIST\ns_001.raw\ns_002.raw\ns_003.raw\n"));
  expect_made_of("a.nhdr",
                 nrrd("encoding: raw\ndata file: LIST 2\ns_001.raw\ns_002.raw\ns_003.raw\n"));
  expect_made_of("a.nhdr", nrrd("encoding: raw\ndata file: s_%03d.raw 1 3 1\n"));
  // Downwards, steps of two, digits that grow.
  write("b.nhdr", nrrd("encoding: raw\ndata file: s_%03d.raw 3 1 -1\n"));
  std::vector<Label> turned = labels_of("b.nhdr");
  EXPECT_EQ(std::vector<Label>(turned.begin(), turned.begin() + 35),
            std::vector<Label>(made_.labels.end() - 35, made_.labels.end()));
  fs::create_directory(folder_ / "in");
  write_slices("in/t", "", 98, 2, 2);
  expect_made_of("a.nhdr", nrrd("encoding: raw\ndata file: in/t%d 98 102 2\n"));
  for (const char* wrong :
       {"LIST\n", "LIST\ns_001.raw\ns_002.raw\n", "s_%03d.raw 1 3\n", "s_%03d.raw 1 4 1\n",
        "s_%03d.raw 3 1 1\n", "s_%03d.raw 1 3 0\n", "s_%s.raw 1 3 1\n", "s_%03d%d.raw 1 3 1\n",
        "s_%999d.raw 1 3 1\n", "s_%03d.raw 1 999999999 1\n", "%\n"}) {
    SCOPED_TRACE(wrong);
    expect_refused_of("a.nhdr", nrrd(std::string("encoding: raw\ndata file: ") + wrong), {});
  }
  // Packed files, and one that holds too little, which is named.
  const std::string bytes = made_.bytes<std::uint16_t>();
  for (std::size_t z = 0; z < 3; ++z) {
    write("p" + std::to_string(z), test::packed(bytes.substr(z * 70, 70), true));
  }
  expect_made_of("a.nhdr", nrrd("encoding: gzip\ndata file: p%d 0 2 1\n"));
  write("p1", test::packed(bytes.substr(70, 69), true));
  expect_refused("a.nhdr", {"p1", "70 bytes"});
  expect_refused_of("a.nhdr", nrrd(std::string("encoding: raw\ndata file: s_\0001\n", 30)),
                    {"control characters"});
  fs::remove(path("s_002.raw"));
  expect_refused_of("a.nhdr", nrrd("encoding: raw\ndata file: s_%03d.raw 1 3 1\n"), {"s_002.raw"});
}

TEST_F(HeaderVolumes, ReadsNrrdAsText) {
  expect_made_of("a.nrrd", nrrd("encoding: ascii\n\n") + text());
  // A size that is not read.
  expect_refused_of("a.nrrd",
                    nrrd("axis mins: 0 0 0\naxis maxs: 7 5 3\nencoding: ascii\n\n") + text(),
                    {"axis mins", "--voxel-size"});
  write("a.txt", text());
  expect_made_of("a.nhdr", nrrd("encoding: text\ndata file: a.txt\n"));
  expect_refused_of("a.nrrd", nrrd("encoding: txt\n\n") + text().substr(0, text().size() - 4), {});
  expect_refused_of("a.nrrd", nrrd("encoding: txt\n\n") + "x" + text(), {"\"x0\""});
  expect_refused_of("a.nrrd", nrrd("encoding: bzip2\n\n") + "BZh9", {"bzip2", "gzip"});
}

TEST_F(HeaderVolumes, ReadsTheChosenOfFourAxesOfNrrd) {
  const std::string little = "endian: little\nencoding: raw\ntype: ushort\n";
  const auto write_nrrd = [&](const std::vector<int>& counts, const std::string& fields,
                              const std::string& bytes) {
    write("a.nrrd", "NRRD0005\n" + sizes(counts) + little + fields + "\n" + bytes);
  };
  const std::string beside = mixed<std::uint16_t>(2, true);
  const std::string behind = mixed<std::uint16_t>(2, false);
  for (const char* kinds :
       {"kinds: list domain domain domain\n", "kinds: vector space space space\n",
        "kinds: list domain domain domain\nspace directions: none (2,0,0) "
        "(0,2,0) (0,0,2)\n"}) {
    write_nrrd({2, 7, 5, 3}, kinds, beside);
    expect_refused("a.nrrd", {"2 channels"});
    expect_made("a.nrrd", channel(1));
    EXPECT_EQ(labels_of("a.nrrd", channel(2)), labels(200)) << kinds;
  }
  write_nrrd({2, 7, 5, 3}, "spacings: nan 1 1 2\n", beside);
  EXPECT_EQ(labels_of("a.nrrd", frame(2)), labels(200));
  EXPECT_EQ(geometry("a.nrrd", frame(2)).voxel_volume(), 2.0);
  for (const char* kinds :
       {"", "kinds: domain domain domain time\n", "kinds: domain domain domain ???\n"}) {
    write_nrrd({7, 5, 3, 2}, kinds, behind);
    expect_refused("a.nrrd", {"2 frames"});
    EXPECT_EQ(labels_of("a.nrrd", frame(2)), labels(200)) << kinds;
  }
  // In the middle, and both at once.
  std::string between;
  for (std::size_t z = 0; z < 3; ++z) {
    for (std::size_t c = 0; c < 2; ++c) between += behind.substr(c * 210 + z * 70, 70);
  }
  write_nrrd({7, 5, 2, 3}, "kinds: domain domain list domain\n", between);
  EXPECT_EQ(labels_of("a.nrrd", channel(2)), labels(200));
  write_nrrd({2, 7, 5, 3, 2}, "kinds: list domain domain domain time\n",
             beside + std::string(beside.size(), '\1'));
  VolumeChoice both = channel(2);
  both.frame = 1;
  EXPECT_EQ(labels_of("a.nrrd", both), labels(200));
  both.frame = 2;
  EXPECT_EQ(labels_of("a.nrrd", both), std::vector<Label>(105, 257));
  // One that is of one place is none.
  write_nrrd({1, 7, 5, 3}, "kinds: list domain domain domain\n", made_.bytes<std::uint16_t>());
  expect_made("a.nrrd");
  write_nrrd({7, 5}, "", made_.bytes<std::uint16_t>());
  expect_refused("a.nrrd", {"one image"});
  write_nrrd({7, 5, 3}, "kinds: domain domain list\n", made_.bytes<std::uint16_t>());
  expect_refused("a.nrrd", {"2 dimensions of space"});
  write_nrrd({7, 5, 3}, "kinds: domain domain\n", made_.bytes<std::uint16_t>());
  expect_refused("a.nrrd", {"another number of axes"});
  write_nrrd({7, 5, 3}, "space directions: (1,0,0) none (0,0,1)\nkinds: domain domain domain\n",
             made_.bytes<std::uint16_t>());
  expect_refused("a.nrrd", {"without a direction"});
}

TEST_F(HeaderVolumes, KeepsTheNamesOfSlicersSegments) {
  const std::string segments =
      "Segment0_ID:=Segment_1\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment0_Name:=Quartz\n"
      "Segment1_LabelValue:=2\nSegment1_Layer:=1\nSegment1_Name:=Clay, wet\n"
      "Segment10_LabelValue:=3\nSegment10_Layer:=0\nSegment10_Name:=Feldspar\n";
  expect_made_of("a.seg.nrrd",
                 nrrd("encoding: raw\n" + segments + "\n") + made_.bytes<std::uint16_t>());
  EXPECT_EQ(open_volume(path("a.seg.nrrd"))->names(),
            (std::map<Label, std::string>{{1, "Quartz"}, {3, "Feldspar"}}));
  write("a.seg.nrrd", "NRRD0004\ntype: ushort\n" + sizes({2, 7, 5, 3}) +
                          "endian: little\nencoding: gzip\nkinds: list domain domain domain\n" +
                          segments + "\n" + test::packed(mixed<std::uint16_t>(2, true), true));
  EXPECT_EQ(labels_of("a.seg.nrrd", channel(2)), labels(200));
  EXPECT_EQ(open_volume(path("a.seg.nrrd"), channel(2))->names(),
            (std::map<Label, std::string>{{2, "Clay, wet"}}));
}

TEST_F(HeaderVolumes, SaysOfASizeWhenItFitsNot) {
  const std::string bytes = made_.bytes<std::uint16_t>();
  expect_made_of("a.nrrd", nrrd("encoding: raw\n\n") + bytes + "\n");
  EXPECT_TRUE(test::holds(notes("a.nrrd").at(0), "211 bytes"));
  // Twice as many: types of four bytes, another size.
  expect_refused_of("a.nrrd", nrrd("encoding: raw\n\n") + bytes + bytes, {"420 bytes", "210"});
  expect_refused_of(
      "a.nrrd",
      nrrd("spacings: 1 1 1\nspace units: \"mm\" \"mm\" \"um\"\nencoding: raw\n\n") + bytes,
      {"\"mm\"", "\"um\""});
  write("a.nrrd",
        nrrd("spacings: 1 1 1\nunits: \"micron\" \"\xc2\xb5m\" \"um\"\nencoding: raw\n\n") + bytes);
  EXPECT_EQ(geometry("a.nrrd").unit, "um");
  EXPECT_TRUE(notes("a.nrrd").empty());
  VolumeChoice choice;
  choice.voxel_size = Vector3(2, 2, 2);
  choice.unit = "mm";
  EXPECT_EQ(geometry("a.nrrd", choice).unit, "mm");
}

TEST_F(HeaderVolumes, RefusesLengthsOfVoxelsThatAreNotAboveZero) {
  const std::string bytes = made_.bytes<std::uint16_t>();
  VolumeChoice size;
  size.voxel_size = Vector3(1, 2, 3);
  for (const char* lengths : {"-1 -1 -1", "1 -1 2", "-2 -1 1", "1 0 1", "1e400 1 1"}) {
    SCOPED_TRACE(lengths);
    const std::string text = lengths;
    write("a.nrrd", nrrd("encoding: raw\nspacings: " + text + "\n\n") + bytes);
    write("a.mha", meta("ElementSpacing = " + text + "\nElementDataFile = LOCAL\n") + bytes);
    write("a.vti", test::packed_vti(made_, "<ImageData WholeExtent=\"0 6 0 4 0 2\" Spacing=\"" +
                                               text + "\"><Piece Extent=\"0 6 0 4 0 2\">"));
    std::string commas = text;
    std::replace(commas.begin(), commas.end(), ' ', ',');
    write("a.raw", bytes);
    write("a.json", R"({"dimensions": [7, 5, 3], "type": "uint16", "spacing": [)" + commas + "]}");
    for (const char* name : {"a.nrrd", "a.mha", "a.vti", "a.json"}) {
      if (text.find("e400") != std::string::npos) {
        expect_refused(name, {});
        continue;
      }
      expect_refused(name, {"the spacing ", "above 0", "--voxel-size"});
      expect_made(name, size);
    }
  }
  // Directions that are not perpendicular are honoured and told.
  write("a.nrrd", nrrd("encoding: raw\nspace dimension: 3\nspace directions: (1,0,0) (0.5,1,0) "
                       "(0,0,2)\n\n") +
                      bytes);
  const auto warnings_with = [&](VolumeChoice choice) {
    return open_volume(path("a.nrrd"), choice)->warnings();
  };
  ASSERT_EQ(warnings_with({}).size(), 1U);
  EXPECT_TRUE(test::holds(warnings_with({})[0].text(), "not perpendicular"));
  VolumeChoice advised;
  advised.voxel_size = Vector3(1, 1, 2);
  EXPECT_TRUE(warnings_with(advised).empty());
  // A direction may be backwards.
  expect_made_of("a.nrrd",
                 nrrd("encoding: raw\nspace dimension: 3\nspace directions: (-1,0,0) (0,1,0) "
                      "(0,0,-2)\n\n") +
                     bytes);
}

TEST_F(HeaderVolumes, ReadsMetaImageOfEveryTypeAndForm) {
  const std::string end = "ElementDataFile = LOCAL\n";
  expect_made_of("a.mha", meta(end, "MET_LONG") + made_.bytes<std::int32_t>());
  expect_made_of("a.mha", meta("BinaryDataByteOrderMSB = True\n" + end, "MET_ULONG") +
                              made_.bytes<std::uint32_t>(true));
  expect_made_of("a.mha", meta(end, "MET_ULONG_LONG") + made_.bytes<std::uint64_t>());
  expect_made_of("a.mha", meta("ElementByteOrderMSB = True\n" + end, "MET_LONG_LONG") +
                              made_.bytes<std::int64_t>(true));
  expect_made_of("a.mha", meta(end, "MET_CHAR") + made_.bytes<std::int8_t>());
  for (const std::size_t size : {4U, 8U}) {
    std::string bytes;
    for (const Label label : made_.labels) {
      const auto single = static_cast<float>(label);
      const auto twice = static_cast<double>(label);
      bytes.append(size == 4 ? reinterpret_cast<const char*>(&single)
                             : reinterpret_cast<const char*>(&twice),
                   size);
    }
    expect_made_of("a.mha", meta(end, size == 4 ? "MET_FLOAT" : "MET_DOUBLE") + bytes);
  }
  expect_made_of("a.mha", meta("BinaryData = False\n" + end) + text());
  // Packed without saying so, as some writers did.
  for (const bool is_gzip : {false, true}) {
    made_ = MadeVolume({37, 21, 3});
    made_.labels.back() = 300;
    expect_made_of("a.mha", meta("CompressedData = False\n" + end) +
                                test::packed(made_.bytes<std::uint16_t>(), is_gzip));
  }
  for (const auto& [fields, word] : std::vector<std::pair<std::string, std::string>>{
           {"NDims = 2\n" + end, "2 dimensions"},
           {"ObjectType = Mesh\n" + end, "no image"},
           {"ElementSpacing = 1 1\n" + end, "another number of axes"},
           {"TransformMatrix = 1 0 0 1\n" + end, "another number of axes"},
           {"ElementNumberOfChannels = 0\n" + end, "dimension of 0"}}) {
    expect_refused_of("a.mha", meta(fields) + made_.bytes<std::uint16_t>(), {word});
  }
}

TEST_F(HeaderVolumes, ReadsMetaImageInManyFilesAndOfMoreThanOneVolume) {
  write_slices("s_", ".raw", 1, 1, 3);
  for (const char* files :
       {"LIST\ns_001.raw\ns_002.raw\ns_003.raw\n", "LIST 2\ns_001.raw\ns_002.raw\ns_003.raw\n",
        "s_%03d.raw 1 3 1\n", "s_%03d.raw 1 3\n", "s_%03d.raw 1\n", "s_%03d.raw\n"}) {
    expect_made_of("a.mhd", meta(std::string("ElementDataFile = ") + files));
  }
  expect_refused_of("a.mhd", meta("ElementDataFile = s_%03d.raw 0\n"), {"s_000.raw"});
  write_slices("t_", ".raw", 5, 1, 3);  // the last follows from the first
  expect_made_of("a.mhd", meta("ElementDataFile = t_%03d.raw 5\n"));
  expect_refused_of("a.mha",
                    meta("ElementNumberOfChannels = 2\nDistanceUnits = mm\nElementSpacing = 1 2 "
                         "3\nElementDataFile = LOCAL\n") +
                        mixed<std::uint16_t>(2, true),
                    {"2 channels"});
  EXPECT_EQ(labels_of("a.mha", channel(2)), labels(200));
  EXPECT_EQ(geometry("a.mha", channel(2)).unit, "mm");
  expect_refused_of(
      "a.mha",
      "NDims = 4\nDimSize = 7 5 3 2\nElementType = MET_USHORT\nElementSpacing = 0.1 0.2 "
      "0.4 1\nOffset = 10 20 30 0\nTransformMatrix = 0 1 0 0 1 0 0 0 0 0 1 0 0 0 0 1\n"
      "ElementDataFile = LOCAL\n" +
          mixed<std::uint16_t>(2, false),
      {"2 frames"});
  EXPECT_EQ(labels_of("a.mha", frame(2)), labels(200));
  // x of the lattice runs along y.
  EXPECT_LT((geometry("a.mha", frame(2)).point({1.5, 0.5, 0.5}) - Vector3(10, 20.1, 30)).norm(),
            1e-12);
}

TEST_F(HeaderVolumes, ReadsTheChosenArrayOfAVti) {
  const auto vti = [&](const std::string& attributes, const std::string& arrays,
                       const std::string& end) {
    return "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\"" + attributes +
           "><ImageData WholeExtent=\"0 6 0 4 0 2\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece "
           "Extent=\"0 6 0 4 0 2\"><PointData Scalars=\"grey\">" +
           arrays + "</PointData></Piece></ImageData>" + end + "</VTKFile>";
  };
  const std::string bytes = made_.bytes<std::uint16_t>();
  const auto with_length = [](const std::string& data) {
    return test::four_bytes(data.size()) + data;
  };
  MadeVolume grey = made_;
  for (Label& label : grey.labels) label += 1000;
  const std::string two =
      "<DataArray type=\"UInt16\" Name=\"grey\" format=\"binary\">" +
      test::base64(with_length(grey.bytes<std::uint16_t>())) +
      "</DataArray><DataArray type=\"UInt16\" Name=\"labels\" format=\"binary\">" +
      test::base64(with_length(bytes)) + "</DataArray>";
  expect_refused_of("a.vti", vti("", two, ""),
                    {"2 arrays", "\"grey\"", "\"labels\"", "--select array=NAME"});
  expect_made("a.vti", array("labels"));
  EXPECT_EQ(labels_of("a.vti", array("grey")), labels(1000));
  expect_refused("a.vti", {"no array \"Labels\"", "\"grey\""}, array("Labels"));
  expect_made_of("a.vti",
                 vti(
                     "",
                     "<DataArray type=\"UInt16\" Name=\"grey\" format=\"appended\" "
                     "offset=\"0\"/><DataArray type=\"Float64\" Name=\"a&lt;&amp;lt;\" "
                     "format=\"appended\" offset=\"214\"/>",
                     "<AppendedData encoding=\"raw\">_" + with_length(grey.bytes<std::uint16_t>()) +
                         [&] {
                           std::string data;
                           for (const Label label : made_.labels) {
                             const auto value = static_cast<double>(label);
                             data.append(reinterpret_cast<const char*>(&value), 8);
                           }
                           return with_length(data);
                         }() +
                         "</AppendedData>"),
                 array("a<&lt;"));
  EXPECT_EQ(labels_of("a.vti", array("grey")), labels(1000));
  // As text, and more numbers a voxel than one.
  write(
      "a.vti",
      vti("", "<DataArray type=\"Int32\" Name=\"l\" format=\"ascii\">\n" + text() + "</DataArray>",
          ""));
  expect_made("a.vti");
  expect_made("a.vti", array("l"));
  expect_refused_of(
      "a.vti",
      vti("",
          "<DataArray type=\"UInt16\" Name=\"l\" NumberOfComponents=\"2\" "
          "format=\"binary\">" +
              test::base64(with_length(mixed<std::uint16_t>(2, true))) + "</DataArray>",
          ""),
      {"2 channels"});
  EXPECT_EQ(labels_of("a.vti", channel(2)), labels(200));
}

TEST_F(HeaderVolumes, ReadsVtiPackedByLz4) {
  const std::string bytes = made_.bytes<std::uint16_t>();
  for (const std::size_t block : {64U, 70U, 210U}) {
    std::string sizes;
    std::string blocks;
    std::size_t count = 0;
    for (std::size_t k = 0; k < bytes.size(); k += block, ++count) {
      const std::string part = bytes.substr(k, block);
      std::string packed(1000, '\0');
      packed.resize(static_cast<std::size_t>(
          LZ4_compress_default(part.data(), packed.data(), static_cast<int>(part.size()), 1000)));
      sizes += test::four_bytes(packed.size());
      blocks += packed;
    }
    const auto head = [&](std::size_t blocks_told, std::size_t block_told) {
      return test::four_bytes(blocks_told) + test::four_bytes(block_told) +
             test::four_bytes(bytes.size() % block) + sizes;
    };
    const auto vti = [&](const std::string& lengths) {
      return "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\" "
             "compressor=\"vtkLZ4DataCompressor\"><ImageData WholeExtent=\"0 6 0 4 0 2\"><Piece>"
             "<PointData><DataArray type=\"UInt16\" Name=\"l\" format=\"appended\" offset=\"0\"/>"
             "</PointData></Piece></ImageData><AppendedData encoding=\"raw\">_" +
             lengths + blocks;
    };
    expect_made_of("a.vti", vti(head(count, block)));
    EXPECT_EQ(notes("a.vti").size(), 1U) << "it has no spacing";
    expect_cut_is_refused("a.vti", 10);
    expect_refused_of("a.vti", vti(head(count + 1, block)), {"210"});
    std::string damaged = vti(head(count, block));
    damaged[damaged.size() - blocks.size() + 1] = '\x7f';
    damaged[damaged.size() - blocks.size()] = '\xff';
    expect_refused_of("a.vti", damaged, {});
  }
}

// A scan of 16 bits with noise, labels, labels that look like swapped ones, and floats.
TEST_F(HeaderVolumes, DoubtsTheByteOrder) {
  made_ = MadeVolume({30, 28, 26});
  made_.fill(9000, [](const Vector3&) { return true; });
  made_.fill_ball(21000, {15, 14, 13}, 9.0);
  for (std::size_t k = 0; k < made_.labels.size(); ++k) {
    made_.labels[k] += static_cast<Label>(k * 7919 % 1009);
  }
  const auto read_grey = [&](const std::string& name) {
    const auto volume = open_volume(path(name));
    volume->read_grey_values();
    all_of(*volume);
    return volume->warnings().size();
  };
  const auto refused_grey = [&](const std::string& name, const std::string& word) {
    const std::string told = test::refusal(ErrorCode::InputOutput, [&] { read_grey(name); });
    EXPECT_TRUE(test::holds(told, word));
  };
  write("little.raw", made_.bytes<std::uint16_t>());
  const std::string raw = R"({"dimensions": [30, 28, 26], "file": "little.raw", "spacing": 1, )";
  write("a.json", raw + R"("type": "uint16"})");
  EXPECT_EQ(read_grey("a.json"), 0U);
  write("a.json", raw + R"("type": "int16", "byte_order": "big"})");
  refused_grey("a.json", "\"byte_order\": \"little\"");
  write("a.nrrd", nrrd("encoding: raw\n\n") + made_.bytes<std::uint16_t>(true));
  refused_grey("a.nrrd", "endian: big");
  write("a.mha", meta("BinaryDataByteOrderMSB = True\nElementDataFile = LOCAL\n", "MET_UINT") +
                     made_.bytes<std::uint32_t>());
  refused_grey("a.mha", "BinaryDataByteOrderMSB = False");
  write("a.mha", meta("BinaryDataByteOrderMSB = True\nElementDataFile = LOCAL\n", "MET_UINT") +
                     made_.bytes<std::uint32_t>(true));
  EXPECT_EQ(read_grey("a.mha"), 0U);

  // Fractions of 65535, whose bytes are alike: their exponents tell it.
  for (const bool is_swapped : {false, true}) {
    std::string fractions;
    for (const Label label : made_.labels) {
      const float value = static_cast<float>(label + (label < 15000 ? 3000 : 9000)) / 65535.0F;
      const std::string four(reinterpret_cast<const char*>(&value), sizeof value);
      fractions += is_swapped ? std::string(four.rbegin(), four.rend()) : four;
    }
    write("c.nrrd", nrrd("encoding: raw\n\n", "float") + fractions);
    if (is_swapped) {
      refused_grey("c.nrrd", "endian: big");
    } else {
      EXPECT_EQ(read_grey("c.nrrd"), 0U);
    }
  }

  const auto warnings_of_labels = [&](const std::vector<Label>& values, bool big) {
    made_ = MadeVolume({30, 28, 26});
    for (std::size_t k = 0; k < values.size(); ++k) {
      made_.fill_ball(values[k], {5.0 + 7.0 * static_cast<double>(k), 14, 13}, 3.4);
    }
    write("b.nrrd", nrrd("encoding: raw\nspacings: 1 1 1\n\n") + made_.bytes<std::uint16_t>(big));
    const auto volume = open_volume(path("b.nrrd"));
    all_of(*volume);
    all_of(*volume);
    return volume->warnings().size();
  };
  EXPECT_EQ(warnings_of_labels({1, 2, 300}, true), 1U);
  EXPECT_EQ(warnings_of_labels({1, 2, 300}, false), 0U);
  EXPECT_EQ(warnings_of_labels({256, 512, 768}, false), 0U);
  EXPECT_EQ(warnings_of_labels({4097}, false), 0U) << "two numbers may be anything";
  EXPECT_EQ(warnings_of_labels({}, false), 0U);

  made_.fill_ball(3, {15, 14, 13}, 9.0);
  std::string floats;
  for (const Label label : made_.labels) {
    const auto value = static_cast<float>(label);
    std::string four(reinterpret_cast<const char*>(&value), sizeof value);
    floats += std::string(four.rbegin(), four.rend());
  }
  expect_refused_of("c.nrrd", nrrd("encoding: raw\n\n", "float") + floats, {"endian: big"});
}

TEST_F(HeaderVolumes, HonoursLeftHandedSpacesOfNrrd) {
  const auto placed = [&](const std::string& space) {
    write("a.nrrd", nrrd("space: " + space +
                         "\nspace directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (5,6,7)\n"
                         "encoding: raw\n\n") +
                        made_.bytes<std::uint16_t>());
    return geometry("a.nrrd").point({1.5, 0.5, 0.5});  // the middle of the second voxel
  };
  for (const char* space :
       {"left-anterior-superior", "LAS", "3D-left-handed", "3D-left-handed-time",
        "right-posterior-superior", "Left-Anterior-Superior-Time", "LAST"}) {
    EXPECT_LT((placed(space) - Vector3(-7, 6, 7)).norm(), 1e-12) << space;
  }
  for (const char* space : {"right-anterior-superior", "RAS", "left-posterior-superior", "LPS",
                            "3D-right-handed", "scanner-xyz", "LPST"}) {
    EXPECT_LT((placed(space) - Vector3(7, 6, 7)).norm(), 1e-12) << space;
  }
}

}  // namespace
}  // namespace wscvt
