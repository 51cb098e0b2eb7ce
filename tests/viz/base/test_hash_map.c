/* SPDX-License-Identifier: MIT */
/* test_hash_map.c - items of an array found by their keys. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "array.h"
#include "hash_map.h"

typedef struct item {
    uint64_t id;
    int value;
} item;

static const hash_map_item_type by_id = {sizeof(item), hash_map_hash_id, hash_map_ids_equal};

typedef struct items {
    item *items;
    size_t count, room;
    hash_map map;
} items;

static void add(items *all, uint64_t id)
{
    item *grown = array_reserve(all->items, all->count + 1, &all->room, sizeof *grown);
    assert_non_null(grown);
    all->items = grown;
    all->items[all->count++] = (item){id, (int)(id % 1000)};
    assert_true(hash_map_add(&all->map, &by_id, all->items));
}

static uint32_t find(const items *all, uint64_t id)
{
    return hash_map_find(&all->map, &by_id, all->items, &id);
}

static void release(items *all)
{
    free(all->items);
    hash_map_release(&all->map);
}

/* Among them keys that are equal in their low bits, and in their high ones. */
static void every_item_is_found_by_its_key_and_no_other(void **state)
{
    (void)state;
    items all = {0};
    assert_int_equal(find(&all, 0), HASH_MAP_NONE);
    for (uint64_t i = 0; i < 3000; i++)
        add(&all, i % 3 == 0 ? i : i % 3 == 1 ? i << 40 : ~i);
    for (size_t i = 0; i < all.count; i++)
        assert_int_equal(find(&all, all.items[i].id), i);
    assert_int_equal(find(&all, 1), HASH_MAP_NONE);
    assert_int_equal(find(&all, UINT64_C(3) << 40), HASH_MAP_NONE);
    assert_true(2 * all.map.count <= all.map.size);
    release(&all);
}

static void a_cleared_map_has_nothing_and_takes_items_again(void **state)
{
    (void)state;
    items all = {0};
    hash_map_clear(&all.map);
    for (uint64_t i = 0; i < 100; i++)
        add(&all, i);
    hash_map_clear(&all.map);
    all.count = 0;
    assert_int_equal(find(&all, 5), HASH_MAP_NONE);
    add(&all, 5);
    assert_int_equal(find(&all, 5), 0);
    release(&all);
}

static void an_array_that_cannot_grow_is_left_as_it_was(void **state)
{
    (void)state;
    size_t room = 0;
    int *numbers = array_reserve(NULL, 20, &room, sizeof *numbers);
    assert_int_equal(room, 32);
    assert_ptr_equal(array_reserve(numbers, 32, &room, sizeof *numbers), numbers);
    assert_null(array_reserve(numbers, SIZE_MAX / 4, &room, sizeof *numbers));
    assert_null(array_reserve(numbers, SIZE_MAX, &room, 1));
    assert_int_equal(room, 32);
    free(numbers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_found_by_its_key_and_no_other),
        cmocka_unit_test(a_cleared_map_has_nothing_and_takes_items_again),
        cmocka_unit_test(an_array_that_cannot_grow_is_left_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
