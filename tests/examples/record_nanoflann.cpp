/* SPDX-License-Identifier: MIT */
// record_nanoflann.cpp - a program with an index of its own, nanoflann's k-d tree, records its points and what it asked
// and answered. "octreel audit nanoflann-flight" then says whether it answered rightly, and the film shows where not.
#include <octreel/recorder.h>

#include <nanoflann.hpp>

#include <cstdio>
#include <random>
#include <vector>

struct cloud {
    std::vector<octree_point> points;

    size_t kdtree_get_point_count() const
    {
        return points.size();
    }
    double kdtree_get_pt(size_t i, size_t axis) const
    {
        return points[i].position[axis];
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};
using kd_tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, cloud>, cloud, 3>;

int main()
{
    octreel_recorder_def def = octreel_recorder_def_default(); // world [-1000, 1000]^3
    def.folder = "nanoflann-flight";
    def.replace = true;
    octreel_recorder *recorder; // null where it cannot be opened: a recorder that is off
    octreel_error why;
    if (octreel_recorder_open(&def, &recorder, &why))
        std::puts(why.text);
    std::mt19937 random(1);
    const auto coordinate = [&random] { return random() % 1800000 / 1e3 - 900; };
    cloud all;
    for (uint64_t id = 0; id < 2000; id++)
        all.points.push_back({{coordinate(), coordinate(), coordinate()}, id});
    for (int tick = 0; tick < 20; tick++) {
        for (octree_point &p : all.points)
            p.position[p.id % 3] += p.id % 7 - 3.0;
        kd_tree tree(3, all);
        octree_query asked[10] = {};
        uint64_t ids[10][8];
        for (int i = 0; i < 10; i++) {
            octree_query &q = asked[i];
            q.kind = OCTREE_QUERY_KNEAREST;
            for (double &x : q.target)
                x = coordinate();
            q.k = 8;
            uint32_t found[8];
            double squares[8];
            q.answered = true;
            q.epsilon = 1e-15; // it compares rounded sums
            q.answer = ids[i];
            q.answer_count = tree.knnSearch(q.target, 8, found, squares);
            for (size_t j = 0; j < q.answer_count; j++)
                ids[i][j] = all.points[found[j]].id;
        }
        octreel_tick_info about = {};
        about.points = all.points.data();
        about.point_count = all.points.size();
        about.queries = asked;
        about.query_count = 10;
        octreel_recorder_tick(recorder, nullptr, &about);
    }
    if (octreel_recorder_close(recorder))
        std::puts(octreel_recorder_error(recorder));
    octreel_recorder_destroy(recorder);
}
