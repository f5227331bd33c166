// Motion of SMPL and its like in archives of numpy: out, in, and what numpy itself makes of them.

#include <cmath>
#include <cstdlib>

#include "cli/program.h"
#include "clip/make_character.h"
#include "clip/npy.h"
#include "clip/smpl.h"
#include "rig/posed_rig.h"
#include "rig/put_on.h"

namespace panache::test {
namespace {

using enum HumanJoint;

class Npz : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh", 31);
    const Ran ran = run("convert walk.bvh -o walk.npz");
    if (ran.err.find("expected a name that ends in") != std::string::npos) {
      GTEST_SKIP() << "this build has no libzip";
    }
    ASSERT_EQ(ran.exit, 0) << ran.err;
  }
  Clip bvh_of(const std::string& name) {
    must_quietly({"convert", name, "--force", "-o", name + ".bvh"});
    auto file = parse_bvh(read(name + ".bvh"), name);
    EXPECT_TRUE(file.ok());
    return (*file)->clip();
  }
  // Mean angle between the directions of the limbs of two motions, degrees.
  static double off_deg(const Clip& a, const Clip& b) {
    const Rig rig = *Rig::create(a), other = *Rig::create(b);
    EXPECT_EQ(a.frames - rig.first_frame(), b.frames - other.first_frame());
    PosedRig reader(rig), other_reader(other);
    double sum = 0;
    int count = 0;
    for (int f = 0; f + rig.first_frame() < a.frames; ++f) {
      BodyPose one, two;
      reader.read(a.pose(f + rig.first_frame()), one);
      other_reader.read(b.pose(f + other.first_frame()), two);
      for (const HumanJoint joint : {left_lower_arm, left_hand, right_lower_arm, right_hand,
                                     left_lower_leg, left_foot, right_lower_leg, right_foot}) {
        const int j = index(joint), parent = kHumanParent[j];
        sum += angle_deg(one.joints[j] - one.joints[parent], two.joints[j] - two.joints[parent]);
        ++count;
      }
    }
    return sum / count;
  }
  // Runs a script with the Python that has numpy; nothing where there is none.
  bool has_numpy() { return python("import numpy"); }
  bool python(const std::string& script) {
    write("script.py", script);
    return std::system(("cd '" + path("") + "' && /usr/bin/python3 script.py > out.txt 2> err.txt")
                           .c_str()) == 0;
  }
};

TEST_F(Npz, a_walk_keeps_its_directions_there_and_back) {
  const double off = off_deg(walking_clip(31), bvh_of("walk.npz"));
  std::printf("limbs %.3f deg\n", off);
  // Feet are held on the floor with other legs: that moves knees by less than a degree on average.
  EXPECT_LT(off, 1);
}

TEST_F(Npz, numpy_reads_what_is_written) {
  if (!has_numpy()) GTEST_SKIP() << "there is no numpy; apt-get install python3-numpy";
  EXPECT_TRUE(python(R"(
import numpy as np
d = np.load('walk.npz')
assert sorted(d.files) == ['betas', 'gender', 'mocap_framerate', 'poses', 'trans'], d.files
assert d['poses'].shape == (31, 156) and d['poses'].dtype == np.float64
assert d['trans'].shape == (31, 3) and d['betas'].shape == (16,)
assert str(d['gender']) == 'neutral' and int(d['mocap_framerate']) == 30
# AMASS has Z up: the pelvis stays in height, and the walk of 1.2 m/s goes along -y.
go = d['trans'][30] - d['trans'][0]
assert abs(go[2]) < 0.1 and go[1] < -0.9 and abs(go[0]) < 0.1, go
# Upright is a quarter about x there.
assert abs(np.linalg.norm(d['poses'][:, :3], axis=1) - np.pi / 2).max() < 0.2
)")) << read("err.txt");
}

TEST_F(Npz, what_numpy_writes_is_read_and_kept) {
  if (!has_numpy()) GTEST_SKIP() << "there is no numpy; apt-get install python3-numpy";
  ASSERT_TRUE(python(R"(
import numpy as np
d = dict(np.load('walk.npz'))
d['gender'] = np.array('female')
d['betas'] = np.arange(16.0)
d['dmpls'] = np.zeros((31, 8))
np.savez_compressed('packed.npz', **d)
d['poses'] = d['poses'].astype(np.float32)
np.savez('single.npz', **d)
d['mocap_frame_rate'] = np.int64(30)
del d['mocap_framerate']
d['poses'] = np.concatenate([d['poses'][:, :66], np.zeros((31, 9)), d['poses'][:, 66:]], axis=1)
np.savez('smplx.npz', **d)
d['poses'] = np.concatenate([d['poses'][:, :66], np.zeros((31, 6))], axis=1)
np.savez('smpl.npz', **d)
)")) << read("err.txt");
  const Clip want = bvh_of("walk.npz");
  for (const std::string name : {"packed.npz", "single.npz", "smplx.npz", "smpl.npz"}) {
    EXPECT_LT(off_deg(want, bvh_of(name)), 1e-3) << name;
    must_quietly({"stylize", name, "--style", "old=0", "--force", "-o", "same.npz"});
    EXPECT_TRUE(read("same.npz") == read(name)) << name;
    must_quietly({"stylize", name, "--style", "old=1", "-o", "old/" + name});
  }
  EXPECT_TRUE(python(R"(
import numpy as np
for name in ('packed.npz', 'single.npz', 'smplx.npz', 'smpl.npz'):
    a, b = np.load(name), np.load('old/' + name)
    assert a['poses'].dtype == b['poses'].dtype and a['poses'].shape[1] == b['poses'].shape[1]
    assert len(b['poses']) == len(b['trans']) > 20
    assert str(b['gender']) == 'female' and (b['betas'] == np.arange(16)).all()
    assert 'dmpls' not in b.files
    # Fingers, jaw and eyes are nobody's to change.
    if len(a['poses']) == len(b['poses']):
        assert (a['poses'][:, 66:] == b['poses'][:, 66:]).all()
)")) << read("err.txt");
}

TEST_F(Npz, it_is_a_character_too) {
  must_quietly("retarget walk.bvh --onto walk.npz -o onto.npz");
  EXPECT_LT(off_deg(bvh_of("walk.npz"), bvh_of("onto.npz")), 0.1);
  must_quietly("stylize walk.npz --style old=1 -o old.glb");
  write("hero.glb", to_glb(character()));
  must_quietly("retarget walk.npz --onto hero.glb -o hero-walk.glb");
}

TEST_F(Npz, damaged_archives_get_a_message) {
  const std::string good = read("walk.npz");
  const auto expect_harmless = [&](const std::string& bytes) {
    write("bad.npz", bytes);
    const Ran ran = run("info bad.npz");
    if (ran.exit == 0) return true;
    EXPECT_EQ(ran.exit, 1) << ran.err;
    EXPECT_TRUE(begins(ran.err, "panache: bad.npz: "));
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    return false;
  };
  for (size_t size = 0; size < good.size(); size += good.size() / 23) {
    EXPECT_FALSE(expect_harmless(good.substr(0, size))) << size;
  }
  // The headers of the members, and the table at the end.
  int accepted = 0, rejected = 0;
  const auto spoil = [&](size_t i) {
    std::string bytes = good;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    ++(expect_harmless(bytes) ? accepted : rejected);
  };
  for (size_t i = 0; i < 60; i += 2) spoil(i);
  for (size_t i = good.size() - 300; i < good.size(); i += 4) spoil(i);
  EXPECT_GT(rejected, 30);
  write("none.npz", "no archive");
  EXPECT_EQ(
      run("info none.npz").err,
      "panache: none.npz: expected an archive as numpy.savez writes it, found none (Not a zip "
      "archive)\n");
}

TEST_F(Npz, a_small_archive_does_not_unpack_to_a_large_one) {
  if (!has_numpy()) GTEST_SKIP() << "no Python with numpy";
  ASSERT_TRUE(
      python("import numpy as n\n"
             "for name, frames in ('some', 25000), ('more', 30000):\n"
             "    n.savez_compressed(name, poses=n.zeros((frames, 156)), "
             "trans=n.zeros((frames, 3)), mocap_framerate=60)\n"));
  must_quietly("info some.npz");
  const Ran ran = run("info more.npz");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err,
                     "panache: more.npz: expected at most 32 MB unpacked in a file "
                     "of "));
  EXPECT_TRUE(
      ran.err.ends_with(" bytes, found more; save it with numpy.savez, without "
                        "compression\n"))
      << ran.err;
}

}  // namespace
}  // namespace panache::test
