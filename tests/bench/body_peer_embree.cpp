/* SPDX-License-Identifier: MIT */
// body_peer_embree.cpp - Embree's static hierarchy of boxes, in floats, for rays.
#include "body_peer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{

struct scene {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene handle = nullptr;
    std::vector<octree_body> bodies;
};

void *create(const octree_box *)
{
    return new scene;
}

void destroy(void *self)
{
    scene *s = static_cast<scene *>(self);
    if (s->handle)
        rtcReleaseScene(s->handle);
    rtcReleaseDevice(s->device);
    delete s;
}

void bound_body(const RTCBoundsFunctionArguments *a)
{
    const octree_body &b = static_cast<const scene *>(a->geometryUserPtr)->bodies[a->primID];
    float *lower = &a->bounds_o->lower_x, *upper = &a->bounds_o->upper_x;
    for (int i = 0; i < 3; i++) {
        lower[i] = static_cast<float>(b.position[i] - b.half[i]);
        upper[i] = static_cast<float>(b.position[i] + b.half[i]);
    }
}

// The slab test, in floats.
void intersect_body(const RTCIntersectFunctionNArguments *a)
{
    RTCRayHit *rayhit = reinterpret_cast<RTCRayHit *>(a->rayhit);
    const octree_body &b = static_cast<const scene *>(a->geometryUserPtr)->bodies[a->primID];
    const float *origin = &rayhit->ray.org_x, *direction = &rayhit->ray.dir_x;
    float enter = rayhit->ray.tnear, leave = rayhit->ray.tfar;
    for (int i = 0; i < 3; i++) {
        const float inverse = 1 / direction[i], offset = static_cast<float>(b.position[i]) - origin[i];
        const float x = (offset - static_cast<float>(b.half[i])) * inverse;
        const float y = (offset + static_cast<float>(b.half[i])) * inverse;
        enter = std::max(enter, std::min(x, y));
        leave = std::min(leave, std::max(x, y));
    }
    if (enter > leave || !a->valid[0])
        return;
    rayhit->ray.tfar = enter;
    rayhit->hit.geomID = a->geomID;
    rayhit->hit.primID = a->primID;
}

void build(void *self, const octree_body *bodies, const octree_body *, size_t count)
{
    scene *s = static_cast<scene *>(self);
    s->bodies.assign(bodies, bodies + count);
    if (s->handle)
        rtcReleaseScene(s->handle);
    s->handle = rtcNewScene(s->device);
    RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
    rtcSetGeometryUserData(geometry, s);
    rtcSetGeometryBoundsFunction(geometry, bound_body, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_body);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s->handle, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(s->handle);
}

void move_all(void *self, const octree_body *, const octree_body *to, size_t count)
{
    build(self, to, nullptr, count);
}

void cast(const void *self, const octree_region *regions, size_t count, body_answer *answers)
{
    const scene *s = static_cast<const scene *>(self);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; i++) {
        const octree_region &r = regions[i];
        RTCRayHit ray = {};
        for (int k = 0; k < 3; k++) {
            (&ray.ray.org_x)[k] = static_cast<float>(r.origin[k]);
            (&ray.ray.dir_x)[k] = static_cast<float>(r.direction[k]);
        }
        ray.ray.tfar = std::numeric_limits<float>::infinity();
        ray.ray.mask = 0xffffffffu;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(s->handle, &context, &ray);
        const bool hits = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        answers[i] = {hits, 0, hits ? ray.ray.tfar : 0.0};
    }
}

} // namespace

const body_peer body_peer_embree = {
    "embree",
    create,
    destroy,
    nullptr,
    1e-4,
    {build, nullptr, nullptr, nullptr, move_all},
    {nullptr, nullptr, nullptr, cast},
};
