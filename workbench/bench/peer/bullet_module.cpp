// A sphere against a mesh of triangles by Bullet's collision library, in double precision, as a module of its own
// (peer_query.h): its tree of bounding volumes offers the triangles near the sphere, its test of sphere and triangle
// says where they touch; the deepest counts.
#include "workbench/bench/peer_query.h"

#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>

#include <memory>
#include <numeric>
#include <vector>

namespace tangent::bench {
namespace {

static_assert(sizeof(btScalar) == sizeof(double));
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// Of the triangles near a sphere the one that it enters most.
class DeepestTriangle final : public btTriangleCallback {
 public:
  DeepestTriangle(btSphereShape& sphere, const btVector3& centre) : sphere_(sphere), centre_(centre) {}

  void processTriangle(btVector3* triangle, int, int) override {
    btTriangleShape shape(triangle[0], triangle[1], triangle[2]);
    SphereTriangleDetector detector(&sphere_, &shape, 0.0);
    btVector3 point, normal;
    btScalar depth = 0.0, time = 1.0;
    if (!detector.collide(centre_, point, normal, depth, time, 0.0)) return;
    if (found && depth >= depth_) return;  // negative: how deep
    found = true;
    depth_ = depth;
    deepest = point;
  }

  bool found = false;
  btVector3 deepest{0.0, 0.0, 0.0};

 private:
  btSphereShape& sphere_;
  btVector3 centre_;
  btScalar depth_ = 0.0;
};

class BulletQuery final : public PeerQuery {
 public:
  explicit BulletQuery(const PeerInput& input) : sphere_(input.radius_m), indices_(3 * input.triangles.size()) {
    std::iota(indices_.begin(), indices_.end(), 0);
    btIndexedMesh mesh;
    mesh.m_numTriangles = static_cast<int>(input.triangles.size());
    mesh.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices_.data());
    mesh.m_triangleIndexStride = 3 * sizeof(int);
    mesh.m_numVertices = 3 * mesh.m_numTriangles;
    mesh.m_vertexBase = reinterpret_cast<const unsigned char*>(input.triangles.data());
    mesh.m_vertexStride = sizeof(Vec3);
    mesh.m_indexType = PHY_INTEGER;
    mesh.m_vertexType = PHY_DOUBLE;
    array_.addIndexedMesh(mesh, PHY_INTEGER);
    mesh_ = std::make_unique<btBvhTriangleMeshShape>(&array_, true);
  }
  PeerAnswer ask(const Vec3& centre) override {
    const btVector3 at(centre.x, centre.y, centre.z),
        reach(sphere_.getRadius(), sphere_.getRadius(), sphere_.getRadius());
    DeepestTriangle deepest(sphere_, at);
    mesh_->processAllTriangles(&deepest, at - reach, at + reach);
    const btVector3& p = deepest.deepest;
    return {deepest.found, {p.x(), p.y(), p.z()}, deepest.found ? (p - at).length() : 0.0};
  }

 private:
  btSphereShape sphere_;
  std::vector<int> indices_;
  btTriangleIndexVertexArray array_;
  std::unique_ptr<btBvhTriangleMeshShape> mesh_;
};

}  // namespace
}  // namespace tangent::bench

extern "C" [[gnu::visibility("default")]] tangent::bench::PeerQuery* tangent_peer(
    const tangent::bench::PeerInput& input) {
  return input.radius_m > 0.0 && !input.triangles.empty() ? new tangent::bench::BulletQuery(input) : nullptr;
}
