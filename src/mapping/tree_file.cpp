#include "mapping/tree_file.h"

#include <bitset>
#include <cmath>
#include <cstring>
#include <locale>
#include <sstream>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"

namespace grid_path_planner::mapping {

using base::InputError;
using base::OutputFile;
using base::ReadLimits;
using base::readWholeFile;
using base::writeFileAtomically;

namespace {

using Node = MapTree::Node;

constexpr std::size_t kLargestFile = std::size_t{1} << 32;
constexpr char kBinaryFirstLine[] = "# Octomap OcTree binary file";
constexpr char kFullFirstLine[] = "# Octomap OcTree file";

bool startsWith(const std::string& text, const char* beginning) {
  return text.compare(0, std::strlen(beginning), beginning) == 0;
}

bool endsWith(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

struct Header {
  bool binary;
  bool coloured = false;
  double resolution = 0.0;
  std::size_t nodes = 0;
  std::size_t end = 0;  // where the nodes begin
};

// The value of a header line "NAME VALUE".
template <class Value>
Value headerValue(const std::string& file, int line, std::istringstream& words,
                  const char* expected) {
  Value value;
  if (words >> value) return value;
  throw InputError(file, line, std::string("expected ") + expected);
}

// Whether this reader knows what a node holds. In a .bt it is the same for each kind, and OctoMap does not look at it; in a
// .ot ColorOcTree has three bytes more, and CountingOcTree no log odds.
bool isKnown(const std::string& id, bool binary) {
  return binary || id == "OcTree" || id == "OcTreeStamped" || id == "ColorOcTree";
}

Header readHeader(const std::string& file, const std::string& content) {
  Header header;
  header.binary = startsWith(content, kBinaryFirstLine);
  if (!header.binary && !startsWith(content, kFullFirstLine))
    throw InputError(file, 1, "is not an OctoMap tree (.bt or .ot)");
  std::string id;
  for (int number = 1;; ++number) {
    const std::size_t line_end = content.find('\n', header.end);
    if (line_end == std::string::npos) throw InputError(file, number, "ends inside its header");
    std::istringstream words(content.substr(header.end, line_end - header.end));
    words.imbue(std::locale::classic());
    header.end = line_end + 1;
    std::string name;
    words >> name;
    if (name == "data") break;
    if (name == "id") id = headerValue<std::string>(file, number, words, "id OcTree");
    if (name == "size")
      header.nodes = headerValue<std::size_t>(file, number, words, "size and a number of nodes");
    if (name == "res")
      header.resolution = headerValue<double>(file, number, words, "res and a number of metres");
  }
  if (!isKnown(id, header.binary))  // whose text is not repeated
    throw InputError(file,
                     "holds a tree of another kind than OcTree, OcTreeStamped and ColorOcTree");
  header.coloured = id == "ColorOcTree";
  if (!(header.resolution > 0.0 && std::isfinite(header.resolution)))
    throw InputError(file, "has no positive resolution in its header");
  return header;
}

// What OctoMap takes, with what the allocator adds. Two bytes of a .bt file can make 300 of a tree.
constexpr std::size_t kBytesOfNode = 32, kBytesOfChildren = 80;

class TreeReader {
 public:
  TreeReader(const std::string& file, const std::string& content, const Header& header,
             MapTree& tree, ReadLimits& limits)
      : file_(file),
        content_(content),
        header_(header),
        at_(header.end),
        tree_(tree),
        limits_(limits),
        poll_(limits, file) {}

  void read() {
    if (header_.nodes > 0) {
      Node* root = tree_.createRoot();
      if (header_.binary)
        readBinaryChildren(root, 0);
      else
        readFull(root, 0);
    }
    if (at_ != content_.size())
      throw InputError(
          file_, "goes on for " + std::to_string(content_.size() - at_) + " bytes after the tree");
    if (tree_.size() != header_.nodes)
      throw InputError(file_, "holds " + std::to_string(tree_.size()) + " nodes, its header says " +
                                  std::to_string(header_.nodes));
  }

 private:
  // The meaning of a child's two bits.
  enum Label { UNKNOWN = 0, FREE = 1, OCCUPIED = 2, INNER = 3 };

  void readBinaryChildren(Node* node, int depth) {
    const unsigned low = readByte(), labels = low | readByte() << 8;
    if (labels == 0 || depth == kDepth) throwBadNode();
    takeChildren((labels | labels >> 1) & 0x5555);
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned label = labels >> (2 * i) & 3;
      if (label == UNKNOWN) continue;
      tree_.createNodeChild(node, i)->setLogOdds(label == FREE ? tree_.getClampingThresMinLog()
                                                               : tree_.getClampingThresMaxLog());
    }
    for (unsigned i = 0; i < 8; ++i)
      if ((labels >> (2 * i) & 3) == INNER)
        readBinaryChildren(tree_.getNodeChild(node, i), depth + 1);
    node->updateOccupancyChildren();
  }

  void readFull(Node* node, int depth) {
    node->setLogOdds(readFloat());
    for (int colour = 0; header_.coloured && colour < 3; ++colour) readByte();
    const unsigned children = readByte();
    if (children != 0 && depth == kDepth) throwBadNode();
    takeChildren(children);
    for (unsigned i = 0; i < 8; ++i)
      if (children >> i & 1) readFull(tree_.createNodeChild(node, i), depth + 1);
  }

  // `children`: a bit for each.
  void takeChildren(unsigned children) {
    poll_();
    if (children == 0) return;
    limits_.take(file_, kBytesOfChildren + kBytesOfNode * std::bitset<16>(children).count());
  }

  unsigned readByte() {
    if (at_ == content_.size())
      throw InputError(file_, "is truncated after " + std::to_string(tree_.size()) + " of " +
                                  std::to_string(header_.nodes) + " nodes");
    return static_cast<unsigned char>(content_[at_++]);
  }

  float readFloat() {
    char bytes[sizeof(float)];
    for (char& byte : bytes) byte = static_cast<char>(readByte());
    float value;
    std::memcpy(&value, bytes, sizeof value);
    if (!std::isfinite(value)) throwBadNode();
    return value;
  }

  [[noreturn]] void throwBadNode() const {
    throw InputError(file_, "is damaged before byte " + std::to_string(at_));
  }

  static constexpr int kDepth = 16;

  const std::string& file_;
  const std::string& content_;
  const Header& header_;
  std::size_t at_;
  MapTree& tree_;
  ReadLimits& limits_;
  base::ReadPoll poll_;
};

// Log odds, then a bit for each child, as octomap::OcTree writes them, some ten times as fast.
void appendNodes(const MapTree& tree, const Node* node, std::string& text) {
  const float value = node->getLogOdds();
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
  unsigned children = 0;
  for (unsigned i = 0; i < 8; ++i) children |= tree.nodeChildExists(node, i) ? 1u << i : 0;
  text.push_back(static_cast<char>(children));
  for (unsigned i = 0; i < 8; ++i)
    if (children >> i & 1) appendNodes(tree, tree.getNodeChild(node, i), text);
}

}  // namespace

std::string treeText(const MapTree& tree, const std::vector<std::string>& comments) {
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header.precision(17);
  header << kFullFirstLine << '\n';
  for (const std::string& comment : comments) header << "# " << comment << '\n';
  header << "id OcTree\nsize " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  std::string text = header.str();
  text.reserve(text.size() + tree.size() * (sizeof(float) + 1));
  if (tree.getRoot()) appendNodes(tree, tree.getRoot(), text);
  return text;
}

std::unique_ptr<MapTree> readTreeFile(const std::string& file, const OctreeOptions& model,
                                      ReadLimits& limits) {
  const std::string content = readWholeFile(file, kLargestFile, limits);
  const Header header = readHeader(file, content);
  auto tree = std::make_unique<MapTree>(header.resolution, model);
  TreeReader(file, content, header, *tree, limits).read();
  return tree;
}

void writeTreeFile(const MapTree& tree, const OutputFile& file) {
  if (endsWith(file.name(), ".ot")) return writeFileAtomically(file, treeText(tree));
  if (!endsWith(file.name(), ".bt")) throw InputError(file.name(), "must end in .bt or .ot");
  std::ostringstream content;
  content.imbue(std::locale::classic());
  content.precision(17);
  octomap::OcTree(tree).writeBinary(content);  // rounds and prunes what it is given
  writeFileAtomically(file, content.str());
}

}  // namespace grid_path_planner::mapping
