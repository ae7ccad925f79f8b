// A scene under construction from a file. Nodes come first (their tables in the file's order), then what
// refers to them; effects keep the order in which the file names them, which is the order of Gauss-Seidel.
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "error.h"
#include "scene.h"
#include "scenes/keys.h"
#include "scenes/named.h"
#include "scenes/script.h"

namespace pbdcheck {

/// Nodes [first, first + count) of the scene, the ones a selection may pick and counts from.
struct NodeRange {
  int first = 0;
  int count = 0;
};

/// All nodes but those of rigid bodies, which stand behind them and have names.
NodeRange numbered_nodes(const pbd::Scene& scene);

/// Links, triangles and tetrahedra of a scene. A tetrahedron takes about 1.5 kB in scene and rows, so that
/// this many take 3 GB; more are taken for a typing error.
inline constexpr double most_elements = 2e6;

/// What `make` returns; a SetupError of it gets `where` in front.
template <class Make>
auto located(const std::string& where, Make make) {
  try {
    return make();
  } catch (const pbd::SetupError& error) {
    throw pbd::SetupError(where + ": " + error.what());
  }
}

/// What the tables of bodies and nodes say of contact, until [contact] is read.
struct ContactParts {
  struct Body {
    int body, material;
    pbd::Vec3 surface_velocity;  // m/s, in the shape's frame
  };
  std::vector<Body> bodies;
  pbd::Contact effect;                     // its nodes and triangles
  std::vector<std::string> materials{""};  // the first is that of all that name none
  std::string mentioned;                   // where, if a table speaks of contact
};

struct Builder {
  pbd::Scene scene;
  struct Placed {
    int line;
    pbd::Effect effect;
  };
  std::vector<Placed> placed;
  std::set<int> anchored;
  double elements = 0;
  std::vector<NamedBody> bodies;   // one a body of the scene
  std::vector<NamedJoint> joints;  // their parts' effects by kind, until the scene is finished
  ContactParts contact;

  Script script;

  void add(int line, pbd::Effect effect) { placed.push_back({line, std::move(effect)}); }

  /// Counts the links, triangles or tetrahedra of a body before they are made, and refuses the value of `key`
  /// if the scene has more than `most_elements` with them.
  void reserve(const Keys& keys, std::string_view key, double count);

  /// Anchors `nodes` at their initial places; `keys` names the table in errors: a node twice and one of
  /// infinite mass are refused.
  void anchor(const Keys& keys, const std::vector<int>& nodes, double compliance, pbd::Anchor& effect);

  /// What may name one: "world" and the bodies there are.
  std::vector<std::string> body_names() const;

  /// The body that `key` names; "world", fixed at the origin, is made when it is first asked for.
  int body(Keys& keys, std::string_view key);
  int body(const Keys& keys, std::string_view key, const std::string& name);

  bool moves(int body) const;

  /// The index of the material that `material` names, 0 if the key is absent.
  int material(Keys& keys);

  /// Moves the effects into the scene, in the file's order.
  pbd::Scene finish();
};

/// The nodes a table picks, each once, by `node` (one index), `nodes` (a list), `near_m` (the nearest to a
/// point), `box_m` ([lowest, highest corner]; all within, borders included) or `corners` (a list of places in
/// the nodes' bounding box, 0 to 1 along each axis; the nearest node to each). Indices count from the range's
/// first node; positions are the initial ones. Refuses a table with none or several of these keys, an index
/// out of range or twice, and a box without nodes. To be called after the table's other keys were read.
std::vector<int> select_nodes(Keys& keys, const pbd::Scene& scene, const NodeRange& range);

/// True if one of these keys is there.
bool chooses_nodes(Keys& keys);

/// A compliance or its inverse, the stiffness, whichever of the two keys stands there; 0 if neither does.
double read_compliance(Keys& keys, std::string_view compliance = "compliance_m_per_n",
                       std::string_view stiffness = "stiffness_n_per_m");

/// `damping_s`, a constraint's retardation time; 0, no damping, if absent.
double read_damping(Keys& keys);

/// `over_time`, pairs of a time (s) and a factor; nothing if absent.
std::optional<Course> read_course(Keys& keys);

/// Lower case letters, digits and _.
std::string read_name(Keys& keys, std::string_view key = "name");

/// The file that `file` names, found relative to the scene file's folder.
std::filesystem::path mesh_path(Keys& keys);

/// The table, and the file if its mesh comes from one.
std::string mesh_name(Keys& keys);

/// The rotation by the rotation vector `rotation_rad`; none if absent.
Eigen::Matrix3d read_rotation(Keys& keys);

/// Gives the constraints of an effect from the `first` on the retardation time (s); an effect that has none
/// and gets none stays without.
template <class Effect>
void set_damping(Effect& effect, std::size_t first, double time) {
  if (time == 0 && effect.damping.empty()) return;
  effect.damping.resize(first, 0);
  effect.damping.resize(effect.compliance.size(), time);
}

/// The sub-table `contact` of a table of nodes: those of `range` it chooses touch rigid bodies, all if it
/// chooses none, or those of the surface if there is one, whose triangles may touch other surfaces.
void read_node_contact(Keys& owner, Builder& builder, const NodeRange& range,
                       const std::vector<std::array<int, 3>>& surface = {});

// One function per kind of table; each reads all tables of its kind below the root.
void read_particles(Keys& root, Builder& builder);
void read_chains(Keys& root, Builder& builder);
void read_cloths(Keys& root, Builder& builder);
void read_solids(Keys& root, Builder& builder);
void read_rigid_bodies(Keys& root, Builder& builder);
void read_gravity(Keys& root, Builder& builder);
void read_gyroscopic(Keys& root, Builder& builder);
void read_forces(Keys& root, Builder& builder);
void read_torques(Keys& root, Builder& builder);
void read_anchors(Keys& root, Builder& builder);
void read_distances(Keys& root, Builder& builder);
void read_bendings(Keys& root, Builder& builder);
void read_joints(Keys& root, Builder& builder);
void read_attachments(Keys& root, Builder& builder);
void read_contact(Keys& root, Builder& builder);

}  // namespace pbdcheck
