#include "grid_path_planner/simulation/world.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "support/error_text.h"
#include "support/mutation.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::simulation {

using base::InputError;

namespace {

using test::contains;

std::string sdf(const std::string& content) {
  return "<?xml version='1.0'?>\n<sdf version='1.6'>\n<world name='test'>\n" + content +
         "\n</world>\n</sdf>\n";
}

std::string model(const std::string& name, const std::string& pose, const std::string& shapes) {
  return "<model name='" + name + "'><static>true</static><pose>" + pose +
         "</pose><link name='link'>" + shapes + "</link></model>";
}

std::string shape(const std::string& kind, const std::string& name, const std::string& geometry) {
  return "<" + kind + " name='" + name + "'><geometry>" + geometry + "</geometry></" + kind + ">";
}

const char* const kUnitBox = "<box><size>1 1 1</size></box>";
const char* const kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";

class WorldFile : public ::testing::Test {
 protected:
  World read(const std::string& content) const {
    return readWorld(folder_.write("world.sdf", sdf(content)));
  }
  // What readWorld says against a world with this content.
  std::string complaint(const std::string& content) const {
    return test::errorText([&] { read(content); });
  }
  void writeIn(const std::string& folder, const std::string& name,
               const std::string& content) const {
    std::filesystem::create_directories(folder_.path(folder));
    folder_.write(folder + "/" + name, content);
  }

  const test::TemporaryFolder folder_;
};

void expectBounds(const TriangleMesh& mesh, const Eigen::Vector3f& lowest,
                  const Eigen::Vector3f& highest) {
  EXPECT_TRUE(mesh.bounds().min().isApprox(lowest, 1e-4f)) << mesh.bounds().min().transpose();
  EXPECT_TRUE(mesh.bounds().max().isApprox(highest, 1e-4f)) << mesh.bounds().max().transpose();
}

TEST_F(WorldFile, ReadsEveryShapeByItsName) {
  const World world = read(model(
      "site", "0 0 0 0 0 0",
      shape("collision", "a", "<box><size>1 2 3</size></box>") +
          shape("collision", "b", "<cylinder><radius>2</radius><length>4</length></cylinder>") +
          shape("collision", "c", "<sphere><radius>3</radius></sphere>") +
          shape("collision", "d", "<plane><normal>0 0 1</normal><size>6 8</size></plane>")));
  ASSERT_EQ(world.solid().size(), 4u);
  EXPECT_EQ(world.solid()[0].name, "site::link::a");
  expectBounds(world.solid()[0], {-0.5f, -1.0f, -1.5f}, {0.5f, 1.0f, 1.5f});
  EXPECT_NEAR(world.solid()[1].bounds().max().x(), 2.0f, 0.01f);
  EXPECT_FLOAT_EQ(world.solid()[1].bounds().max().z(), 2.0f);
  EXPECT_FLOAT_EQ(world.solid()[2].bounds().min().z(), -3.0f);
  expectBounds(world.solid()[3], {-3.0f, -4.0f, 0.0f}, {3.0f, 4.0f, 0.0f});
}

TEST_F(WorldFile, PosesAreNested) {
  const World world = read(
      "<model name='outer'><pose>10 0 0 0 0 1.5707963</pose>"
      "<model name='inner'><pose>1 0 0 0 0 0</pose><link name='link'><pose>1 0 0 0 0 0</pose>"
      "<visual name='box'><pose>1 0 5 0 0 0</pose><geometry><box><size>2 1 1</size></box>"
      "</geometry></visual></link></model></model>");
  ASSERT_EQ(world.visible().size(), 1u);
  EXPECT_EQ(world.visible()[0].name, "outer::inner::link::box");
  expectBounds(world.visible()[0], {9.5f, 2.0f, 4.5f}, {10.5f, 4.0f, 5.5f});
}

TEST_F(WorldFile, PosesMayBeRelativeToFrames) {
  const World world = readWorld(folder_.write(
      "frames.sdf",
      "<sdf version='1.7'><world name='w'><frame name='jetty'><pose>5 0 0 0 0 0</pose></frame>"
      "<model name='m'><pose relative_to='jetty'>0 7 0 0 0 0</pose>"
      "<frame name='mast'><pose>0 0 3 0 0 0</pose></frame>"
      "<link name='link'><pose relative_to='mast'>0 0 1 0 0 0</pose>" +
          shape("visual", "box", kUnitBox) + "</link></model></world></sdf>"));
  ASSERT_EQ(world.visible().size(), 1u);
  expectBounds(world.visible()[0], {4.5f, 6.5f, 3.5f}, {5.5f, 7.5f, 4.5f});
}

TEST_F(WorldFile, CollisionsAreTouchedAndVisualsSeenAndEitherStandsInForTheOther) {
  const World world =
      read(model("both", "0 0 0 0 0 0",
                 shape("collision", "touched", kUnitBox) + shape("visual", "seen", kUnitBox)) +
           model("ghost", "0 0 0 0 0 0", shape("visual", "picture", kUnitBox)) +
           model("glass", "0 0 0 0 0 0", shape("collision", "pane", kUnitBox)));
  const auto names = [](const std::vector<TriangleMesh>& meshes) {
    std::string text;
    for (const TriangleMesh& mesh : meshes) text += mesh.name + " ";
    return text;
  };
  EXPECT_EQ(names(world.solid()), "both::link::touched ghost::link::picture glass::link::pane ");
  EXPECT_EQ(names(world.visible()), "both::link::seen ghost::link::picture glass::link::pane ");
}

TEST_F(WorldFile, MeshesBesideTheFileByPathAndByModel) {
  writeIn("meshes", "rock.obj", kTetrahedron);
  writeIn("rock", "rock.obj", kTetrahedron);
  const std::string absolute = "file://" + folder_.path("rock/rock.obj");
  for (const std::string& uri :
       {std::string("meshes/rock.obj"), std::string("model://rock/rock.obj"),
        std::string("file://meshes/rock.obj"), absolute}) {
    const World world = read(
        model("rock", "1 0 0 0 0 0",
              shape("visual", "mesh", "<mesh><uri>" + uri + "</uri><scale>2 3 4</scale></mesh>")));
    ASSERT_EQ(world.solid().size(), 1u) << uri;
    EXPECT_EQ(world.solid()[0].triangles.size(), 4u);
    expectBounds(world.solid()[0], {1.0f, 0.0f, 0.0f}, {3.0f, 3.0f, 4.0f});
  }
}

// A triangle that stands on the xz plane: as the file says, whatever its format holds to be up.
TEST_F(WorldFile, MeshesOfOtherFormatsKeepTheirAxes) {
  folder_.write("sail.stl",
                "solid sail\nfacet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                "vertex 0 0 2\nendloop\nendfacet\nendsolid sail\n");
  folder_.write(
      "sail.dae",
      "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
      "version='1.4.1'><asset><unit name='meter' meter='1'/><up_axis>Z_UP</up_axis></asset>"
      "<library_geometries><geometry id='g'><mesh><source id='p'>"
      "<float_array id='a' count='9'>0 0 0 1 0 0 0 0 2</float_array><technique_common>"
      "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/>"
      "<param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
      "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/>"
      "</vertices><triangles count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
      "<p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
      "<visual_scene id='s'><node id='n'><instance_geometry url='#g'/></node></visual_scene>"
      "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>");
  for (const char* file : {"sail.stl", "sail.dae"}) {
    const World world =
        read(model("boat", "0 0 0 0 0 0",
                   shape("visual", "sail", std::string("<mesh><uri>") + file + "</uri></mesh>")));
    SCOPED_TRACE(file);
    expectBounds(world.visible()[0], {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 2.0f});
  }
}

TEST_F(WorldFile, IncludedModelsAndTheirMeshes) {
  writeIn(
      "models/rock", "model.config",
      "<?xml version='1.0'?><model><name>rock</name><sdf version='1.6'>model.sdf</sdf></model>");
  writeIn("models/rock", "model.sdf",
          "<?xml version='1.0'?><sdf version='1.6'>" +
              model("rock", "0 0 1 0 0 0",
                    shape("visual", "mesh", "<mesh><uri>rock.obj</uri></mesh>")) +
              "</sdf>");
  writeIn("models/rock", "rock.obj", kTetrahedron);
  ASSERT_EQ(setenv("GAZEBO_MODEL_PATH", ("/nowhere:" + folder_.path("models")).c_str(), 1), 0);
  const World world =
      read("<include><uri>model://rock</uri><name>big</name><pose>5 0 0 0 0 0</pose></include>");
  unsetenv("GAZEBO_MODEL_PATH");
  ASSERT_EQ(world.visible().size(), 1u);
  EXPECT_EQ(world.visible()[0].name, "big::link::mesh");
  EXPECT_FLOAT_EQ(world.visible()[0].bounds().min().x(), 5.0f);
}

TEST_F(WorldFile, ModelsThatWouldMoveStandStill) {
  EXPECT_EQ(read("<model name='boat'><link name='link'>" + shape("visual", "box", kUnitBox) +
                 "</link></model>")
                .solid()
                .size(),
            1u);
}

TEST_F(WorldFile, GeometriesOfOtherKindsAreRefusedByName) {
  const std::string text = complaint(
      model("seabed", "0 0 0 0 0 0",
            shape("collision", "ground", "<heightmap><uri>seabed.png</uri></heightmap>")));
  EXPECT_TRUE(contains(text, folder_.path("world.sdf") + ": seabed::link::ground: a <heightmap>"))
      << text;
  const std::string polyline = complaint(
      model("wall", "0 0 0 0 0 0",
            shape("visual", "line",
                  "<polyline><point>0 0</point><point>1 0</point><height>1</height></polyline>")));
  EXPECT_TRUE(contains(polyline, "wall::link::line")) << polyline;
  EXPECT_TRUE(
      contains(complaint(model("m", "0 0 0 0 0 0",
                               shape("visual", "v",
                                     "<mesh><uri>a.obj</uri><submesh><name>b</name></submesh>"
                                     "</mesh>"))),
               "m::link::v: a <submesh> is not read"));
}

TEST_F(WorldFile, MissingAndDamagedMeshesAreNamed) {
  const auto with_mesh = [](const std::string& uri) {
    return model("rock", "0 0 0 0 0 0",
                 shape("visual", "mesh", "<mesh><uri>" + uri + "</uri></mesh>"));
  };
  const std::string missing = complaint(with_mesh("meshes/rock.obj"));
  EXPECT_TRUE(contains(missing, "world.sdf: rock::link::mesh: there is no mesh meshes/rock.obj"))
      << missing;
  EXPECT_TRUE(contains(complaint(with_mesh("http://far.away/rock.obj")), "http://far.away"));
  folder_.write("text.obj", "this is not a mesh\n");
  folder_.write("text.xyz", "nor is this\n");
  for (const char* name : {"text.obj", "text.xyz"})
    EXPECT_TRUE(contains(complaint(with_mesh(name)), folder_.path(name))) << name;
}

TEST_F(WorldFile, ErrorsOfSyntaxNameFileAndLine) {
  const std::string file = folder_.write(
      "broken.sdf", "<sdf version='1.6'>\n<world name='w'>\n<model\n</world></sdf>\n");
  const std::string text = test::errorText([&] { readWorld(file); });
  EXPECT_EQ(text.find(file + ": "), 0u) << text;
  EXPECT_TRUE(contains(text, "3")) << text;
  EXPECT_FALSE(contains(text, "\n"));
}

// libsdformat throws what std::stoi does: all that was said was 'stoi'.
TEST_F(WorldFile, AVersionThatIsNoneIsRefused) {
  for (const char* version : {"W1.6", "99999999999.6"}) {
    const std::string file =
        folder_.write("version.sdf", std::string("<sdf version='") + version +
                                         "'>\n<world name='w'></world></sdf>\n");
    EXPECT_EQ(test::errorText([&] { readWorld(file); }),
              file + ": libsdformat does not accept it: a number in it is none (stoi)");
  }
}

TEST_F(WorldFile, ValuesThatAreNoneAreRefused) {
  const std::string text =
      complaint(model("m", "0 0 0 0 0 0", shape("visual", "v", "<box><size>1 x 2</size></box>")));
  EXPECT_TRUE(contains(text, "size")) << text;
  EXPECT_TRUE(
      contains(complaint(model("m", "0 0 0 0 0 0",
                               shape("visual", "v", "<sphere><radius>-1</radius></sphere>"))),
               "m::link::v: the radius of a sphere must be"));
}

TEST_F(WorldFile, PosesThatAreNoneAreRefusedWithFileAndName) {
  for (const char* pose : {"nan 0 0 0 0 0", "0 inf 0 0 0 0", "0 0 2e7 0 0 0", "0 0 0 nan 0 0"}) {
    const std::string text = complaint(model("m", pose, shape("visual", "v", kUnitBox)));
    EXPECT_EQ(text.find(folder_.path("world.sdf") + ": "), 0u) << pose << ": " << text;
  }
}

// libsdformat and Assimp would wait for its other end.
// The vehicle says, and publishes, what it runs into.
TEST_F(WorldFile, NamesThatATerminalObeysAreRefusedWithoutQuotingThem) {
  const std::string escape = "a\x1b[2Jb";
  const std::string shapes = shape("visual", "v", kUnitBox);
  for (const std::string& content : {model(escape, "0 0 0 0 0 0", shapes),
                                     model("m", "0 0 0 0 0 0", shape("visual", escape, kUnitBox)),
                                     "<model name='m'><static>true</static><link name='" + escape +
                                         "'>" + shapes + "</link></model>"}) {
    const std::string text = complaint(content);
    EXPECT_TRUE(contains(text, "must not hold control characters")) << text;
    EXPECT_TRUE(contains(text, folder_.path("world.sdf"))) << text;
    EXPECT_FALSE(contains(text, "\x1b"));
  }
  const std::string number = complaint(
      model("m", "0 0 0 0 0 0", shape("visual", "v", "<box><size>1 x\x1b[2J 2</size></box>")));
  EXPECT_NE(number, "");
  EXPECT_FALSE(contains(number, "\x1b"));
}

TEST_F(WorldFile, NamesOfAnyLengthAreRefused) {
  const std::string text =
      complaint(model(std::string(257, 'm'), "0 0 0 0 0 0", shape("visual", "v", kUnitBox)));
  EXPECT_TRUE(contains(text, "the name of a model has 257 bytes, expected at most 256")) << text;
  const World world =
      read(model(std::string(256, 'm'), "0 0 0 0 0 0", shape("visual", "\xd1\x84", kUnitBox)));
  EXPECT_EQ(world.solid().at(0).name, std::string(256, 'm') + "::link::\xd1\x84");
}

TEST_F(WorldFile, APipeIsRefusedAtOnce) {
  for (const char* name : {"pipe.sdf", "pipe.obj"})
    ASSERT_EQ(::mkfifo(folder_.path(name).c_str(), 0600), 0);
  EXPECT_TRUE(contains(test::errorText([&] { readWorld(folder_.path("pipe.sdf")); }),
                       "pipe.sdf: is no regular file"));
  const std::string mesh = "<mesh><uri>" + folder_.path("pipe.obj") + "</uri></mesh>";
  EXPECT_TRUE(contains(complaint(model("m", "0 0 0 0 0 0", shape("collision", "c", mesh))),
                       "is no regular file"));
}

TEST_F(WorldFile, FilesThatAreNoWorldAreRefused) {
  EXPECT_EQ(test::errorText([] { readWorld("no/such.sdf"); }),
            "no/such.sdf: cannot be read: No such file or directory");
  EXPECT_TRUE(contains(complaint(""), "its world is empty"));
  const std::string only_model = folder_.write(
      "model.sdf",
      "<sdf version='1.6'>" + model("m", "0 0 0 0 0 0", shape("visual", "v", kUnitBox)) + "</sdf>");
  EXPECT_EQ(test::errorText([&] { readWorld(only_model); }), only_model + ": has no <world>");
  EXPECT_THROW(readWorld(folder_.write("empty.sdf", "")), InputError);
  EXPECT_THROW(readWorld(folder_.path("")), InputError);
  EXPECT_TRUE(contains(complaint("<include><uri>model://nothing</uri></include>"), "nothing"));
}

TEST_F(WorldFile, DamagedFilesAreReadOrRefusedByName) {
  const std::string good = sdf(
      model("m", "1 2 3 0 0 1",
            shape("collision", "c", "<cylinder><radius>0.5</radius><length>2</length></cylinder>") +
                shape("visual", "v", kUnitBox)));
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const std::string file = folder_.write("damaged.sdf", test::mutated(good, random));
    const std::string text = test::errorText([&] { readWorld(file); });
    EXPECT_TRUE(text.empty() || text.find(file + ": ") == 0) << "seed " << seed << ": " << text;
  }
}

TEST_F(WorldFile, AfterARefusalTheNextWorldIsRead) {
  EXPECT_NE(complaint("<model"), "");
  EXPECT_EQ(read(model("m", "0 0 0 0 0 0", shape("visual", "v", kUnitBox))).solid().size(), 1u);
}

}  // namespace
}  // namespace grid_path_planner::simulation
