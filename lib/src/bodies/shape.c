/* SPDX-License-Identifier: MIT */
/* shape.c - the tests of bodies and cells against a region: one row of functions for each kind of region.
 *
 * A kind has six functions. Two decide about a body, exactly. One returns a box around the region. One relates the
 * eight octants of a cell to the region, in doubles: it must not exclude an octant, or call it inside, unless this is
 * certain. One prepares bounds for the bodies of a level, and one excludes bodies of a leaf. The boxes of nodes are
 * related in relate.c.
 */
#include "shape.h"
#include "../exact/float_mode.h"

/* ---- Boxes and balls ---------------------------------------------------------------------------------------- */

static bool meets_box(const shape *s, const octree_body *body)
{
    return body_meets_box(body, &s->region->box);
}

static bool is_in_box(const shape *s, const octree_body *body)
{
    return body_is_in_box(body, &s->region->box);
}

static octree_box bounds_of_box(const shape *s)
{
    return s->region->box;
}

/* Whether all points within `half` of a centre are in an interval. */
static bool is_half_within(double center, double half, double low, double high)
{
    const double error = (fabs(center) + half) * 0x1p-50;
    return (center - half) - error >= low && (center + half) + error <= high;
}

/* The keys of the traversal have excluded octants already. */
static octant_masks relate_box(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    unsigned inside = 0xff;
    for (int i = 0; i < 3; i++)
        for (int half = 0; half < 2; half++)
            if (!is_half_within(h->center[i][half], contained ? h->outer[i][half] : h->inner[i][half],
                                s->region->box.min[i], s->region->box.max[i]))
                inside &= ~(unsigned)octants_beside[i][half];
    return (octant_masks){(uint8_t)octants, (uint8_t)inside};
}

static bool meets_ball(const shape *s, const octree_body *body)
{
    return body_meets_ball(body, s->region->center, s->region->radius);
}

static bool is_in_ball(const shape *s, const octree_body *body)
{
    return body_is_in_ball(body, s->region->center, s->region->radius);
}

static octree_box bounds_of_ball(const shape *s)
{
    octree_box bounds;
    for (int i = 0; i < 3; i++) {
        bounds.min[i] = exact_add_down(s->region->center[i], -s->region->radius);
        bounds.max[i] = exact_add_up(s->region->center[i], s->region->radius);
    }
    return bounds;
}

/* If the radius is so large that its square overflows, no octant is excluded or inside. */
static octant_masks relate_ball(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    double near[8], far[3][2];
    const double scale = s->level->tree->scale, radius = s->region->radius * scale, square = radius * radius;
    const double above = metric_above(square), below = square * (1 - 0x1p-40) - 0x1p-900;
    unsigned meets = 0, inside = 0;
    bound_squares_of_octants(&s->bounds, h, near);
    for (int i = 0; i < 3; i++)
        for (int half = 0; half < 2; half++) {
            const double center = h->center[i][half];
            const double extent = contained ? h->outer[i][half] : h->inner[i][half];
            far[i][half] = (fabs(s->region->center[i] - center) + extent) * scale;
        }
    for (unsigned left = octants; left; left &= left - 1) {
        const unsigned o = bits_lowest(left), x = o >> 2, y = o >> 1 & 1, z = o & 1;
        const double farthest = (far[0][x] * far[0][x] + far[1][y] * far[1][y]) + far[2][z] * far[2][z];
        meets |= mask_if(!(near[o] > above), 1u << o);
        inside |= mask_if(farthest < below && below <= DBL_MAX, 1u << o);
    }
    return (octant_masks){(uint8_t)meets, (uint8_t)inside};
}

/* ---- Half-spaces -------------------------------------------------------------------------------------------- */

static bool meets_half_spaces(const shape *s, const octree_body *body)
{
    for (size_t i = 0; i < s->region->half_space_count; i++)
        if (!body_meets_half_space(body, s->region->half_spaces[i].normal, s->region->half_spaces[i].offset))
            return false;
    return true;
}

static bool is_in_half_spaces(const shape *s, const octree_body *body)
{
    for (size_t i = 0; i < s->region->half_space_count; i++)
        if (!body_is_in_half_space(body, s->region->half_spaces[i].normal, s->region->half_spaces[i].offset))
            return false;
    return true;
}

static octree_box bounds_of_half_spaces(const shape *s)
{
    (void)s;
    return (octree_box){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
}

/* The products of a half-space with the halves of a cell on one axis. */
typedef struct half_products {
    double middle[2]; /* normal * center */
    double inner[2];  /* |normal| * the half extent whose points must be inside */
    double outer[2];
} half_products;

/* Returns more than the error of any sum of these products and the offset. */
static double multiply_halves(const octree_half_space *space, const cell_halves *h, bool contained,
                              half_products products[3])
{
    double size = fabs(space->offset);
    for (int i = 0; i < 3; i++) {
        half_products *p = &products[i];
        const lanes normal = lanes_all(space->normal[i]), steep = lanes_absolute(normal);
        lanes_store(p->middle, lanes_multiply(normal, lanes_load(h->center[i])));
        lanes_store(p->outer, lanes_multiply(steep, lanes_load(h->outer[i])));
        lanes_store(p->inner, lanes_multiply(steep, lanes_load(contained ? h->outer[i] : h->inner[i])));
        size += larger(fabs(p->middle[0]) + p->outer[0], fabs(p->middle[1]) + p->outer[1]);
    }
    return size * 0x1p-48 + 0x1p-1000;
}

/* Sums that are NaN or infinite exclude nothing: then the error is infinite or NaN, too. */
static octant_masks relate_half_space(const octree_half_space *space, const cell_halves *h, bool contained)
{
    half_products p[3];
    const double error = multiply_halves(space, h, contained, p);
    const lanes middle_z = lanes_load(p[2].middle), outer_z = lanes_load(p[2].outer), inner_z = lanes_load(p[2].inner);
    const lanes limit = lanes_all(error), inner_limit = lanes_all(-error);
    unsigned misses = 0, inside = 0;
    for (unsigned o = 0; o < 8; o += 2) {
        const unsigned x = o >> 2, y = o >> 1 & 1;
        const lanes middle = lanes_add(lanes_all(p[0].middle[x] + p[1].middle[y] - space->offset), middle_z);
        const lanes outer = lanes_add(lanes_all(p[0].outer[x] + p[1].outer[y]), outer_z);
        const lanes inner = lanes_add(lanes_all(p[0].inner[x] + p[1].inner[y]), inner_z);
        misses |= lanes_less(limit, lanes_subtract(middle, outer)) << o;
        inside |= lanes_less(lanes_add(middle, inner), inner_limit) << o;
    }
    return (octant_masks){(uint8_t)~misses, (uint8_t)inside};
}

static octant_masks relate_half_spaces(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    octant_masks all = {(uint8_t)octants, 0xff};
    for (size_t i = 0; i < s->region->half_space_count && all.meets; i++) {
        const octant_masks masks = relate_half_space(&s->region->half_spaces[i], h, contained);
        all.meets &= masks.meets;
        all.inside &= masks.inside;
    }
    return all;
}

/* ---- Rays and moving boxes ---------------------------------------------------------------------------------- */

static bool meets_cast(const shape *s, const octree_body *body)
{
    cast_time first;
    return cast_touches(&s->cast, body, &first);
}

static bool is_in_cast(const shape *s, const octree_body *body)
{
    (void)s, (void)body;
    return false;
}

static octant_masks relate_cast(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    double bounds[8];
    unsigned meets = 0;
    (void)contained;
    bound_times_of_octants(&s->bounds, h, bounds);
    for (unsigned o = 0; o < 8; o++)
        meets |= mask_if(bounds[o] <= DBL_MAX, 1u << o);
    return (octant_masks){(uint8_t)(meets & octants), 0};
}

/* The end of the motion is rounded outwards: its error is below 4 * 2^-53 of the terms. */
static octree_box bounds_of_cast(const shape *s)
{
    const cast *c = &s->cast;
    octree_box bounds;
    for (int i = 0; i < 3; i++) {
        const double way = c->sign[i] == 0 ? 0 : c->sign[i] * (c->speed[i] * c->length);
        const double end = c->origin[i] + way, error = (fabs(c->origin[i]) + fabs(way)) * 0x1p-50 + 0x1p-1000;
        const double low = way < 0 ? end - error : c->origin[i], high = way > 0 ? end + error : c->origin[i];
        bounds.min[i] = low < -DBL_MAX ? low : exact_add_down(low, -c->half[i]);
        bounds.max[i] = high > DBL_MAX ? high : exact_add_up(high, c->half[i]);
    }
    return bounds;
}

/* ---- Bodies of a leaf --------------------------------------------------------------------------------------- */

static uint64_t filter_by_box(const shape *s, const octree_point *points, unsigned count)
{
    return test_box(&s->bounds, points, count);
}

static uint64_t filter_by_ball(const shape *s, const octree_point *points, unsigned count)
{
    double bounds[SCAN_POINTS + 1];
    const double radius = s->region->radius * s->level->tree->scale;
    return bound_squares(&s->bounds, points, count, metric_above(radius * radius), bounds);
}

static uint64_t filter_by_cast(const shape *s, const octree_point *points, unsigned count)
{
    double bounds[SCAN_POINTS + 1];
    return bound_times(&s->bounds, points, count, DBL_MAX, bounds);
}

static query_bounds prepare_for_box(const shape *s, const level *l)
{
    return prepare_box_test(l, &s->region->box);
}

static query_bounds prepare_for_ball(const shape *s, const level *l)
{
    return prepare_squares(l, s->region->center);
}

/* Half-spaces need no bounds. */
static query_bounds prepare_for_half_spaces(const shape *s, const level *l)
{
    (void)l;
    return s->bounds;
}

static query_bounds prepare_for_cast(const shape *s, const level *l)
{
    return prepare_times(l, &s->cast);
}

/* ---- The table ---------------------------------------------------------------------------------------------- */

typedef struct shape_kind {
    bool (*meets)(const shape *s, const octree_body *body);
    bool (*contains)(const shape *s, const octree_body *body);
    octree_box (*bounds)(const shape *s);
    octant_masks (*relate)(const shape *s, const cell_halves *h, unsigned octants, bool contained);
    query_bounds (*prepare)(const shape *s, const level *l);
    uint64_t (*filter)(const shape *s, const octree_point *points, unsigned count);
} shape_kind;

static const shape_kind kinds[OCTREE_REGION_KINDS] = {
    [OCTREE_REGION_BOX] = {meets_box, is_in_box, bounds_of_box, relate_box, prepare_for_box, filter_by_box},
    [OCTREE_REGION_BALL] = {meets_ball, is_in_ball, bounds_of_ball, relate_ball, prepare_for_ball, filter_by_ball},
    [OCTREE_REGION_HALF_SPACES] = {meets_half_spaces, is_in_half_spaces, bounds_of_half_spaces, relate_half_spaces,
                                   prepare_for_half_spaces, filter_by_half_spaces},
    [OCTREE_REGION_SWEPT] = {meets_cast, is_in_cast, bounds_of_cast, relate_cast, prepare_for_cast, filter_by_cast},
    [OCTREE_REGION_RAY] = {meets_cast, is_in_cast, bounds_of_cast, relate_cast, prepare_for_cast, filter_by_cast},
};

shape shape_make(const octree_region *region)
{
    shape s = {.region = region};
    if (region->kind == OCTREE_REGION_RAY)
        s.cast = cast_make_ray(region->origin, region->direction, region->length, region->half);
    if (region->kind == OCTREE_REGION_SWEPT)
        s.cast = cast_make_sweep(region->from, region->to, region->half);
    return s;
}

void shape_enter_level(shape *s, const level *l)
{
    s->level = l;
    s->bounds = kinds[s->region->kind].prepare(s, l);
}

bool shape_meets(const shape *s, const octree_body *body)
{
    return kinds[s->region->kind].meets(s, body);
}

bool shape_contains(const shape *s, const octree_body *body)
{
    return kinds[s->region->kind].contains(s, body);
}

octant_masks shape_relate(const shape *s, const cell_halves *h, unsigned octants, bool contained)
{
    return kinds[s->region->kind].relate(s, h, octants, contained);
}

uint64_t shape_filter(const shape *s, const octree_point *points, unsigned count)
{
    return kinds[s->region->kind].filter(s, points, count);
}

octree_box shape_bounds(const shape *s)
{
    return kinds[s->region->kind].bounds(s);
}

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static octree_status check_half_spaces(const octree_half_space *half_spaces, size_t count)
{
    if (count == 0 || count > OCTREE_MAX_HALF_SPACES)
        return OCTREE_BAD_SIZE;
    if (!half_spaces)
        return OCTREE_NULL_ARGUMENT;
    octree_status status = OCTREE_OK;
    for (size_t i = 0; i < count && status == OCTREE_OK; i++)
        status = isfinite(half_spaces[i].offset) ? check_direction(half_spaces[i].normal) : OCTREE_NOT_FINITE;
    return status;
}

static octree_status check_ray(const octree_region *region)
{
    octree_status status = check_finite_position(region->origin);
    if (status == OCTREE_OK)
        status = check_direction(region->direction);
    if (status == OCTREE_OK)
        status = isnan(region->length) ? OCTREE_NOT_FINITE : region->length < 0 ? OCTREE_BAD_SIZE : OCTREE_OK;
    return status == OCTREE_OK ? check_half_extents(region->half) : status;
}

static octree_status check_swept(const octree_region *region)
{
    if (!is_finite_position(region->from) || !is_finite_position(region->to))
        return OCTREE_NOT_FINITE;
    return check_half_extents(region->half);
}

static octree_status check_ball(const octree_region *region)
{
    const octree_status status = check_finite_position(region->center);
    return status == OCTREE_OK ? check_length(region->radius) : status;
}

octree_status octree_region_check(const octree_region *region)
{
    RETURN_IN_DEFAULT_MODE(octree_status, octree_region_check, region);
    if (!region)
        return OCTREE_NULL_ARGUMENT;
    switch (region->kind) {
    case OCTREE_REGION_BOX:
        return check_box(&region->box);
    case OCTREE_REGION_BALL:
        return check_ball(region);
    case OCTREE_REGION_HALF_SPACES:
        return check_half_spaces(region->half_spaces, region->half_space_count);
    case OCTREE_REGION_SWEPT:
        return check_swept(region);
    case OCTREE_REGION_RAY:
        return check_ray(region);
    case OCTREE_REGION_KINDS:
        break;
    }
    return OCTREE_BAD_OPTION;
}
