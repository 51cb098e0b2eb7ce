# SPDX-License-Identifier: MIT
# hunt.awk - a session in which much happens in every tick: swarms of points cross the world, and a player hunts them.
# What it catches is taken out at the next tick, and born again among another swarm.
#   awk -f tests/examples/hunt.awk | octreel record - -o hunt

BEGIN {
    seed = 11 # of random()
    swarms = 6; members = 450; spread = 14; ticks = 240; step = 4; reach = 5
    for (swarm = 0; swarm < swarms; swarm++)
        for (axis = 0; axis < 3; axis++) {
            middle[swarm, axis] = 160 * random() - 80
            speed[swarm, axis] = 3 * random() - 1.5
        }
    for (last = 1; last <= swarms * members; last++) {
        bear(last, last % swarms, 0)
        points = points (last > 1 ? ",\n" : "") body(last)
    }
    for (tick = 1; tick <= ticks; tick++) {
        edits = replace_caught(tick)
        if (edits != "")
            lines = lines "{\"tick\": " tick ", \"edits\": [" edits "]}\n"
        keys = keys hunt(tick)
    }
    printf "{\"octreel\": \"session\", \"version\": 2,\n"
    printf " \"world\": {\"min\": [-100, -100, -100], \"max\": [100, 100, 100]},\n"
    printf " \"tree\": {\"capacity\": 16, \"depth\": 8, \"full\": \"grow\"},\n"
    printf " \"player\": {\"id\": 0, \"position\": [0, 0, 0], \"step\": %d, \"box_size\": %d},\n", step, reach
    printf " \"queries\": [{\"radius\": 20, \"at\": \"player\"}, {\"knearest\": 4, \"at\": \"player\"}],\n"
    printf " \"keys\": \"%s\", \"ticks\": %d, \"points\": [\n%s]}\n%s", keys, ticks, points, lines
}

# The same numbers in [0, 1) from every awk.
function random()
{
    seed = seed * 16807 % 2147483647
    return seed / 2147483647
}

function bell() { return random() + random() + random() + random() - 2 }

# A coordinate after so many ticks at a constant speed, thrown back by the world's faces.
function fold(at, speed, ticks,   way)
{
    way = at + speed * ticks + 100
    way -= 400 * int(way / 400)
    if (way < 0)
        way += 400
    return (way > 200 ? 400 - way : way) - 100
}

# A point comes to its swarm, at a tick.
function bear(id, swarm, tick,   axis, at)
{
    for (axis = 0; axis < 3; axis++) {
        at = fold(middle[swarm, axis], speed[swarm, axis], tick) + spread * bell()
        place[id, axis] = sprintf("%.1f", at > 100 ? 100 : at < -100 ? -100 : at)
        way[id, axis] = sprintf("%.2f", speed[swarm, axis] + 0.12 * bell())
    }
    born[id] = tick
}

function body(id)
{
    return sprintf("{\"id\": %d, \"position\": [%s, %s, %s], \"velocity\": [%s, %s, %s]}", id, place[id, 0],
                   place[id, 1], place[id, 2], way[id, 0], way[id, 1], way[id, 2])
}

function offset(id, axis, tick) { return fold(place[id, axis], way[id, axis], tick - born[id]) - player[axis] }

# The edits that take out what was caught, and put as many into another swarm.
function replace_caught(tick,   edits, i)
{
    for (i = 0; i < caught; i++) {
        delete born[catch[i]]
        bear(last, (prey + 3) % swarms, tick - 1)
        edits = edits (i ? ", " : "") "{\"remove\": " catch[i] "}, {\"insert\": " body(last++) "}"
    }
    return edits
}

# The nearest point, the one with the lowest id of several.
function nearest(tick,   id, axis, sum, least, found)
{
    least = 1e9
    for (id in born) {
        sum = 0
        for (axis = 0; axis < 3 && sum <= least; axis++)
            sum += offset(id, axis, tick) ^ 2
        if (sum < least || sum == least && id + 0 < found) {
            least = sum
            found = id + 0
        }
    }
    return found
}

# A step along the axis on which the prey is farthest; where it meets points the game takes it back, and they are caught.
function hunt(tick,   axis, most, toward, far, id, i, inside)
{
    prey = nearest(tick)
    for (i = 0; i < 3; i++) {
        far = offset(prey, i, tick)
        if (i == 0 || far * far > most * most) {
            most = far
            axis = i
        }
    }
    toward = most < 0 ? -step : step
    player[axis] += toward
    caught = 0
    for (id in born) {
        inside = 1
        for (i = 0; i < 3; i++)
            inside = inside && offset(id, i, tick) ^ 2 <= reach * reach
        if (inside)
            catch[caught++] = id + 0
    }
    if (caught)
        player[axis] -= toward
    return substr("asfdwe", axis + (toward < 0 ? 1 : 4), 1)
}
