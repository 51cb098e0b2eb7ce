/* SPDX-License-Identifier: MIT */
#include "explained.h"
#include "fixture.h"

#include <string.h>

place film_into(const temp_folder *own, const char *name, const octree_session *session, const film_options *how)
{
    const place folder = place_in(own, name);
    film_options options = how ? *how : small_film("");
    options.folder = folder.path;
    assert_filmed(session, &options);
    return folder;
}

place film_twice(const temp_folder *own, const char *keys, place *b)
{
    const octree_session session = short_session(keys);
    *b = film_into(own, "b", &session, NULL);
    return film_into(own, "a", &session, NULL);
}

comparison_of assert_explained(const place *a, const place *b, uint64_t most)
{
    comparison_of made = assert_compared(a->path, b->path, NULL);
    octreel_error error = {""};
    if (!explain(&made.a, &made.b, &made.result, most, &made.why, &error))
        fail_msg("%s", error.text);
    return made;
}
