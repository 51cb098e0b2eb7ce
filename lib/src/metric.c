/* metric.c - see metric.h. */
#include "metric.h"
#include "exact.h"

#include <math.h>

double metric_scale(const octree_box *world)
{
    double extent = 0;
    for (int i = 0; i < 3; i++) {
        const double side = world->max[i] / 2 - world->min[i] / 2;
        extent = side > extent ? side : extent;
    }
    int exponent;
    frexp(extent, &exponent);
    exponent = exponent < -999 ? -999 : exponent > 1019 ? 1019 : exponent;
    return ldexp(1.0, -exponent - 1);
}

metric metric_make(double scale, const double target[3])
{
    metric m = {.scale = scale};
    for (int i = 0; i < 3; i++) {
        m.target[i] = target[i];
        m.scaled[i] = target[i] * scale;
    }
    return m;
}

int metric_compare(const double target[3], const double a[3], const double b[3])
{
    /* |a - t|^2 - |b - t|^2 = sum of a^2 - 2at - b^2 + 2bt: twelve exact products, less where coordinates agree. */
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < 3; i++) {
        if (a[i] == b[i])
            continue;
        exact_add_product(&sum, 1, a[i], a[i]);
        exact_add_product(&sum, -2, a[i], target[i]);
        exact_add_product(&sum, -1, b[i], b[i]);
        exact_add_product(&sum, 2, b[i], target[i]);
    }
    return exact_sign(&sum);
}

int metric_compare_radius(const double target[3], const double p[3], double radius)
{
    exact_sum sum;
    exact_clear(&sum);
    for (int i = 0; i < 3; i++) {
        exact_add_product(&sum, 1, p[i], p[i]);
        exact_add_product(&sum, -2, p[i], target[i]);
        exact_add_product(&sum, 1, target[i], target[i]);
    }
    exact_add_product(&sum, -1, radius, radius);
    return exact_sign(&sum);
}

double metric_distance(const double a[3], const double b[3])
{
    /* Halves where a difference could overflow; they are exact there. */
    const double unit =
        fabs(a[0]) + fabs(a[1]) + fabs(a[2]) + fabs(b[0]) + fabs(b[1]) + fabs(b[2]) > 0x1p1000 ? 0.5 : 1;
    double gap[3], largest = 0;
    for (int i = 0; i < 3; i++) {
        gap[i] = fabs(a[i] * unit - b[i] * unit);
        largest = gap[i] > largest ? gap[i] : largest;
    }
    if (0x1p-480 < largest && largest < 0x1p480)
        return sqrt((gap[0] * gap[0] + gap[1] * gap[1]) + gap[2] * gap[2]) / unit;
    int exponent;
    frexp(largest, &exponent);
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double scaled = ldexp(gap[i], -exponent);
        square += scaled * scaled;
    }
    return ldexp(sqrt(square), exponent) / unit;
}
