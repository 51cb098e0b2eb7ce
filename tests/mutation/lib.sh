# SPDX-License-Identifier: MIT
# The part of tests/mutation/run for lib: its sources, its objects in each set, and its tests.
# shellcheck shell=sh disable=SC2034,SC2154 # variables of run

sets='whole shared portable'
sanitizer=$("$cc" -print-file-name=libasan.so)
[ ! -f "$sanitizer" ] || sets="$sets sanitized" # who has clang's has no such file
sources='lib/src/*/*.[ch]'
prefix=lib/src

rules="-std=c17 -O1 $types -ffp-contract=off -D_POSIX_C_SOURCE=200809L -Ilib/include -Ilib/src/tree -Ilib/src/exact
       -I$root/tests/support -I$root/tests/support/oracle"

flags_of()
{
    case $1 in
        shared) echo -DOCTREE_LEAST_SHARE=4 ;;
        portable) echo -DOCTREE_PORTABLE ;;
        sanitized) echo -fsanitize=address,undefined -fno-sanitize-recover=all ;;
    esac
}

compile_one()
{
    # shellcheck disable=SC2046,SC2086 # lists of flags
    "$cc" $rules $(flags_of "$1") -fPIC -MMD -c "$2" -o "$3"
}

link_library()
{
    # shellcheck disable=SC2046 # a list of flags
    "$cc" $(flags_of "$1") -shared -o "$1/liboctree.so" "$1"/*.o -lm
}

dependents_of()
{
    grep -l "${2#lib/src/}" "$1.whole"/*.d | sed "s|.*/\([a-z]*\)-\(.*\)\.d|lib/src/\1/\2.c|"
}

prepare()
{
    mkdir -p lib programs
    cp -R "$root/lib/src" "$root/lib/include" lib
    for set_ in $sets; do
        make_set "$set_" lib/src/*/*.c || stop 'lib/src does not compile'
    done
    compile_tests
    for set_ in $sets; do
        for file in programs/test_*; do
            name=${file#programs/}
            is_of "$set_" "$name" || continue
            run_test "$set_" "$name" 300 || stop "$name fails without any mutant, with the library $(flags_of "$set_")"
            echo "$(spent_seconds) $set_ $name"
        done
    done >timed
    sort -s -n timed >order
}

compile_tests()
{
    oracle=
    if echo '#include <gmp.h>' | "$cc" -E - >gmp.i 2>gmp.log; then
        oracle=-lgmp
    fi
    # shellcheck disable=SC2086
    for support in "$root"/tests/support/*.c ${oracle:+"$root"/tests/support/oracle/*.c}; do
        "$cc" $rules -c "$support" -o "programs/$(basename "$support" .c).o" || stop 'tests/support does not compile'
    done
    for file in "$root"/tests/lib/*/test_*.c "$root"/tests/threads/test_executor.c; do
        name=$(basename "$file" .c)
        echo "${file#"$root"/tests/}" | sed 's|^lib/||; s|\.c$||' | grep -qE "$tests" || continue
        case $name in
            test_exact*) [ -n "$oracle" ] || continue ;;
        esac
        # shellcheck disable=SC2086
        "$cc" $rules "$file" programs/*.o -Lwhole -loctree -lcmocka $oracle -lm -lpthread -o "programs/$name" ||
            stop "$name does not compile"
    done
}

# As in tests/CMakeLists.txt, except that all tests also run with the portable library.
is_of()
{
    case $1:$2 in
        shared:test_executor | shared:test_many | shared:test_move_many | shared:test_reworld | shared:test_grid_fill) true ;;
        shared:* | *:test_executor) false ;;
    esac
}

tests_for()
{
    awk -v s="$1" '$2 == s { print $2, $3, $1 }' order
}

start_test()
{
    unset OCTREE_TEST_EXECUTOR # one that is empty is one
    [ "$1" != shared ] || export OCTREE_TEST_EXECUTOR=shuffled
    [ "$1" != sanitized ] || export LD_PRELOAD="$sanitizer"
    LD_LIBRARY_PATH=$PWD/$1 timeout 1000 "programs/$2"
}
