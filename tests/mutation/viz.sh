# SPDX-License-Identifier: MIT
# The part of tests/mutation/run for viz: its sources, its objects, and the tests that run a line.
# shellcheck shell=sh disable=SC2034,SC2154 # variables of run

sets=whole
sources='viz/[!f]*/*.c viz/f[!a]*/*.c' # without faces and page/module, which are not linked into the program
prefix=viz

flags_of()
{
    case $1 in
        counted) echo -O0 --coverage -w ;;
    esac
}

compile_one()
{
    eval "$(cat "flags/$(basename "$3")") $(flags_of "$1") -o $3 -c $PWD/$2"
}

# All rooms and the program are one library, so that a mutant needs one compilation and one link. A child that ends with
# _exit() would not write its counters.
link_library()
{
    if [ "$1" = counted ]; then
        echo 'void __gcov_dump(void); void __real__exit(int);
              void __wrap__exit(int s); void __wrap__exit(int s) { __gcov_dump(); __real__exit(s); }' >exit.c
        # shellcheck disable=SC2086
        "$cc" -shared --coverage -Wl,-Bsymbolic,--wrap=_exit -fPIC -o "$1/libviz.so" exit.c "$1"/*.o generated/*.o $linked
    else
        # shellcheck disable=SC2086
        "$cc" -shared -Wl,-Bsymbolic -o "$1/libviz.so" "$1"/*.o generated/*.o $linked
    fi
}

dependents_of()
{
    echo "$2"
}

prepare()
{
    cp -Rp "$root/CMakeLists.txt" "$root/README.md" "$root/golden" "$root/lib" "$root/viz" "$root/tests" .
    build_all
    # shellcheck disable=SC2046,SC2086 # a pattern, a list of names
    cksum $sources lib/src/*/* viz/*/*.h >sum
    for set_ in whole counted; do
        cmp -s sum "$set_.whole/sum" && continue
        # shellcheck disable=SC2046
        make_set "$set_" $(cat made) || stop 'viz does not compile'
        cp sum "$set_.whole"
    done
    link_tests
    mkdir -p reached
    awk -v tests="$tests" '$2 "/" $1 ~ tests' tests_of >asked
    while read -r name room; do
        if ! is_newer "reached/$name" "programs/$name" || ! is_newer "reached/$name" counted.whole/sum; then
            see_what_runs "$name"
        fi
        [ ! -f "reached/$name.spent" ] || echo "$(cat "reached/$name.spent") whole $name $room"
    done <asked | sort -s -n >order
}

is_newer()
{
    [ -n "$(find "$1" -newer "$2" 2>log)" ]
}

# Build all objects with cmake. Those of the tests are linked here; those of viz are compiled again for each set.
build_all()
{
    cmake -S . -B build -G Ninja -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS="-O1 $types" \
        -DOCTREEL_HARDENING=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_TESTING=ON >log || stop 'cmake fails'
    ninja -C build -t targets all | sed -n 's|^\(tests/CMakeFiles/\(test_[a-z_]*\)\.dir/viz/\([a-z]*\)/test_[a-z_]*\.c\.o\): .*|\2 \3 \1|p' |
        grep -v test_recorder_memory | sort -k2,2 -s >test_objects
    cut -d' ' -f1,2 test_objects >tests_of
    # shellcheck disable=SC2046
    ninja -C build octreel octreel_embed octreel_heap_peak $(cut -d' ' -f3 test_objects) \
        $(ninja -C build -t targets all | sed -n 's|^\(tests/lib[a-z_]*\.a\): .*|\1|p') >log ||
        stop 'viz does not compile'
    mkdir -p flags generated
    : >made
    ninja -C build -t commands octreel octreel_embed >compiling
    sed -n 's/ -fPIE / -fPIC /; s/^\(.*\) -MD -MT [^ ]* -MF [^ ]* -o \(viz.*\.o\) -c .*/\2 \1/p' compiling >commands
    while read -r object command; do
        name=$(echo "$object" | sed 's|^viz/CMakeFiles/[a-z_]*\.dir/||; s|\.c\.o$||')
        if [ "$name" = faces/faces_convert ]; then
            continue
        elif [ -f "viz/$name.c" ]; then
            echo "viz/$name.c" >>made
            printf '%s\n' "$command" >"flags/$(object_of "viz/$name.c")"
        else
            cp -p "build/$object" generated
        fi
    done <commands
    linked="build/lib/liboctree.a $(ninja -C build -t commands octreel | tail -n 1 | tr ' ' '\n' | grep -E '^(-l|/.*\.so$)' |
        sort -u | tr '\n' ' ') -lpthread"
}

# Link every test, and the program that tests run, with libviz.so instead of the rooms.
link_tests()
{
    mkdir -p programs
    # shellcheck disable=SC2046
    ninja -C build -t commands $(cut -d' ' -f1 tests_of) | sed -n 's/^: && \(.*\) && :$/\1/p' | grep -- ' -o bin/test_' |
        sed 's# viz/liboctreel_[a-z]*\.a##g; s# lib/liboctree\.a##g; s# -o bin/# -o ../programs/#; s#$# -L../whole -lviz#' >links
    (cd build && while read -r link; do
        made=${link#* -o } object=${link%% -o *}
        if ! is_newer "${made%% *}" "${object##* }" || ! is_newer "${made%% *}" tests/liboctreel_viz_support.a; then
            eval "$link" || exit 1
        fi
    done <../links) || stop 'tests do not link'
    "$cc" -o build/bin/octreel -Lwhole -lviz || stop 'octreel does not link'
}

# Run a test with counters. If it fails, run it without them; if it still fails, it is not used.
see_what_runs()
{
    rm -f counted/*.gcda "reached/$1.spent"
    passes=true
    run_test counted "$1" 300 || passes=false
    spent=$(spent_seconds)
    gcov --stdout counted/*.gcda 2>log | awk -v root="$PWD/" -v all=counters '
        / 0:Source:/ { file = substr($0, index($0, "Source:") + 7); sub("^" root, "", file); next }
        file ~ /^viz\// { split($0, part, ":"); at = part[1]; gsub(/[ *]/, "", at); line = file ":" part[2] + 0
            if (at != "-" && at != "") print line >all
            if (at ~ /^[0-9]+$/ && at > 0) print line }' >"reached/$1"
    if $passes || run_test whole "$1" 300; then
        echo "$spent" >"reached/$1.spent"
    else
        printf '%s fails without any mutant, and is left out\n' "$1" >&2
    fi
}

# The tests that run the line, or any line of the file if the line has no counter; those of its room first.
tests_for()
{
    where="$2:$3"
    grep -qx "$where" counters || where="$2:[0-9]*"
    room=${2#viz/}
    grep -lx "$where" reached/test_* | sed 's|reached/||' >running || true
    awk -v room="${room%%/*}" 'NR == FNR { runs[$1] = 1; next } $3 in runs { print $4 != room, $2, $3, $1 }' running order |
        sort -s -k1,1n | cut -d' ' -f2-
}

start_test()
{
    rm -rf tmp
    mkdir -p tmp build/tests
    limit=$((60 + 5 * $3))
    library=$PWD/$1
    program=$PWD/programs/$2
    export TMPDIR="$PWD/tmp"
    (cd build/tests && LD_LIBRARY_PATH=$library timeout "$limit" "$program")
}
