#include "rig/surface_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace panache {
namespace {

constexpr int kBlock = 4;  // Cells along a side of a block.
constexpr float kMaxCells = 2e6f;
constexpr int kNone = -1;

class SurfaceNet {
 public:
  SurfaceNet(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high, float cell)
      : distance_(distance), low_(low), cell_(cell) {
    const Vec3 size = (high - low) / cell;
    for (const auto& [count, length] :
         {std::pair<int*, float>{&nx_, size.x}, {&ny_, size.y}, {&nz_, size.z}}) {
      *count = static_cast<int>(std::ceil(length / kBlock)) * kBlock + 1;
    }
    values_.resize(size_t(nx_) * ny_ * nz_);
    vertex_of_.assign(values_.size(), kNone);
    sample();
  }

  // False if there are more vertices than indices can address.
  bool build(TriangleMesh& out) {
    place_vertices(out);
    if (out.vertices.size() > 0xffff) return false;
    connect(out);
    return true;
  }

 private:
  size_t at(int x, int y, int z) const { return (size_t(z) * ny_ + y) * nx_ + x; }
  Vec3 place(float x, float y, float z) const { return low_ + Vec3{x, y, z} * cell_; }

  // If the middle of a block is further from the surface than its corners, one value suffices.
  void sample() {
    constexpr float kHalf = 0.5f * kBlock;
    const float reach = kHalf * 1.7320508f * cell_ * 1.3f;
    for (int z = 0; z < nz_; z += kBlock) {
      for (int y = 0; y < ny_; y += kBlock) {
        for (int x = 0; x < nx_; x += kBlock) {
          const float middle = distance_(place(x + kHalf, y + kHalf, z + kHalf));
          fill(x, y, z, middle, std::abs(middle) > reach);
        }
      }
    }
  }

  void fill(int x0, int y0, int z0, float middle, bool far) {
    for (int z = z0; z < std::min(z0 + kBlock, nz_); ++z) {
      for (int y = y0; y < std::min(y0 + kBlock, ny_); ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, nx_); ++x) {
          values_[at(x, y, z)] = far ? middle : distance_(place(x, y, z));
        }
      }
    }
  }

  void place_vertices(TriangleMesh& out) {
    for (int z = 0; z + 1 < nz_; ++z) {
      for (int y = 0; y + 1 < ny_; ++y) {
        for (int x = 0; x + 1 < nx_; ++x) place_vertex(x, y, z, out);
      }
    }
  }

  // The mean of the surface's intersections with the edges of the cell.
  void place_vertex(int x, int y, int z, TriangleMesh& out) {
    std::array<float, 8> corner;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      corner[c] = values_[at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
      inside += corner[c] < 0;
    }
    if (inside == 0 || inside == 8) return;
    Vec3 sum;
    int cuts = 0;
    for (int a = 0; a < 8; ++a) {
      for (const int bit : {1, 2, 4}) {
        if (a & bit) continue;
        const float from = corner[a], to = corner[a | bit];
        if ((from < 0) == (to < 0)) continue;
        const float t = from / (from - to);
        sum += Vec3{static_cast<float>(a & 1) + (bit == 1 ? t : 0),
                    static_cast<float>(a >> 1 & 1) + (bit == 2 ? t : 0),
                    static_cast<float>(a >> 2) + (bit == 4 ? t : 0)};
        ++cuts;
      }
    }
    vertex_of_[at(x, y, z)] = static_cast<int>(out.vertices.size());
    const Vec3 mean = sum / static_cast<float>(cuts);
    out.vertices.push_back(place(x + mean.x, y + mean.y, z + mean.z));
  }

  // A quad around every edge that the surface cuts.
  void connect(TriangleMesh& out) {
    for (int z = 1; z + 1 < nz_; ++z) {
      for (int y = 1; y + 1 < ny_; ++y) {
        for (int x = 1; x + 1 < nx_; ++x) {
          const bool in = values_[at(x, y, z)] < 0;
          const auto quad = [&](size_t next, std::array<size_t, 4> cells) {
            if ((values_[next] < 0) != in) add_quad(cells, in, out);
          };
          quad(at(x + 1, y, z),
               {at(x, y - 1, z - 1), at(x, y, z - 1), at(x, y, z), at(x, y - 1, z)});
          quad(at(x, y + 1, z),
               {at(x - 1, y, z - 1), at(x - 1, y, z), at(x, y, z), at(x, y, z - 1)});
          quad(at(x, y, z + 1),
               {at(x - 1, y - 1, z), at(x, y - 1, z), at(x, y, z), at(x - 1, y, z)});
        }
      }
    }
  }

  void add_quad(const std::array<size_t, 4>& cells, bool outward, TriangleMesh& out) const {
    std::array<uint16_t, 4> v;
    for (size_t i = 0; i < 4; ++i) v[i] = static_cast<uint16_t>(vertex_of_[cells[i]]);
    if (!outward) std::swap(v[1], v[3]);
    // Along the shorter diagonal.
    const auto far = [&](size_t a, size_t b) {
      return length(out.vertices[v[a]] - out.vertices[v[b]]);
    };
    if (far(0, 2) <= far(1, 3)) {
      out.triangles.insert(out.triangles.end(), {v[0], v[1], v[2], v[0], v[2], v[3]});
    } else {
      out.triangles.insert(out.triangles.end(), {v[0], v[1], v[3], v[1], v[2], v[3]});
    }
  }

  const std::function<float(Vec3)>& distance_;
  Vec3 low_;
  float cell_;
  int nx_ = 0, ny_ = 0, nz_ = 0;  // Grid points.
  std::vector<float> values_;     // [nz][ny][nx]
  std::vector<int> vertex_of_;    // Vertex of the cell above each grid point, or kNone.
};

}  // namespace

TriangleMesh surface_net(const std::function<float(Vec3)>& distance, Vec3 low, Vec3 high,
                         float cell) {
  const Vec3 size = high - low;
  const float cells = size.x * size.y * size.z / (cell * cell * cell);
  if (cells > kMaxCells) cell *= std::cbrt(cells / kMaxCells);
  TriangleMesh out;
  while (!SurfaceNet(distance, low, high, cell).build(out)) {
    out = {};
    cell *= 1.5f;
  }
  return out;
}

}  // namespace panache
