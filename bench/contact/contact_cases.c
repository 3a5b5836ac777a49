/* The cases of `cleave bench contact`: what closed forms say, and how near the figures are asked to be. */
#include <math.h>

#include "contact_bench.h"

#define BOTH(...) {.law = "surface", __VA_ARGS__}, {.law = "pair", __VA_ARGS__}
#define BARS(n, v, least, longest) \
    BOTH(.name = "equal bars, " #n " particles, " #v " c", .measure = contact_bars, .given = {n, n, v, -v}, \
         .asked = {{"restitution", least, 1.001}, {"duration", 1, longest}, {"force", 0, 2.1}, {"energy", 0, 1e-3}})
#define STRIKER(n, off) \
    BOTH(.name = "striker on twice its length, " #n " particles", .measure = contact_striker, \
         .given = {n, 2 * n, 1e-3, 0}, .asked = {{"striker", -off, off}, {"struck", 0.5 - off, 0.5 + off}, {"energy", 0, 1e-3}})
/* Along the lattice, and turned so that velocities are along it. */
#define DISCS(law_, R, v, b, turn, fails_) \
    {.name = "discs, R " #R ", " #v " c, b " #b " R, turn " #turn, .law = law_, .measure = contact_discs, \
     .given = {R, v, b, turn}, .fails = fails_, \
     .asked = {{"normal", b > 0 ? 0.8 : 0.97, 1.03}, {"tangential", 0.95, 1.05}, {"spin", b > 0 ? -0.1 : -1e-6, b > 0 ? 0.1 : 1e-6}, {"energy", 0, 5e-3}}}
#define ALL_DISCS(law_, fails_) \
    DISCS(law_, 20, 1e-3, 0, 0, fails_), DISCS(law_, 20, 1e-2, 0, 0, fails_), DISCS(law_, 20, 5e-2, 0, 0, fails_), \
    DISCS(law_, 20, 1e-2, 1, 0, fails_), DISCS(law_, 20, 1e-2, 1.5, 0, fails_), \
    DISCS(law_, 20, 1e-2, 1, 0.5236, fails_), DISCS(law_, 20, 1e-2, 1.5, 0.8481, fails_), \
    DISCS(law_, 40, 1e-2, 1, 0.5236, fails_), DISCS(law_, 40, 1e-2, 1.5, 0.8481, fails_)

const struct contact_case contact_cases[] = {
    BARS(100, 1e-3, 0.98, 1.05),
    BARS(200, 1e-3, 0.99, 1.03),
    BARS(100, 2e-2, 0.98, 1.05),
    STRIKER(100, 0.02),
    STRIKER(200, 0.01),
    BOTH(.name = "ten bounces between walls, 50 x 10", .measure = contact_bounces, .given = {50, 10, 2e-3},
         .asked = {{"energy", 0, 1e-3}, {"momentum", 0, 1e-12}}),
    BOTH(.name = "cut block, 24 rows, strain -1e-3", .measure = contact_block, .given = {24, 1e-3, 1e-6},
         .asked = {{"force over whole", 0.84, 1.0}}),
    BOTH(.name = "cut block, 48 rows, strain -1e-3", .measure = contact_block, .given = {48, 1e-3, 1e-6},
         .asked = {{"force over whole", 0.92, 1.0}}),
    BOTH(.name = "cut block, 24 rows, opened", .measure = contact_block, .given = {24, -1e-3, 1e-6},
         .asked = {{"force over whole", 0, 1e-9}}),
    BOTH(.name = "cut block, 24 rows, strain -5e-3, sheared", .measure = contact_block, .given = {24, 5e-3, 0.05},
         .asked = {{"force over whole", 0.84, 1.0}, {"along", 0, 0.02}}),
    {.name = "ball on a plane, R 10, 2e-2 c", .law = "surface", .measure = contact_hertz_space, .given = {10, 2e-2},
     .asked = {{"exponent", 1.45, 1.55}, {"duration", 0.9, 1.1}, {"restitution", 0.9, 1}, {"energy", 0, 1e-3}}},
    {.name = "ball on a plane, R 20, 2e-2 c", .law = "surface", .measure = contact_hertz_space, .given = {20, 2e-2},
     .asked = {{"exponent", 1.45, 1.55}, {"duration", 0.9, 1.1}, {"restitution", 0.9, 1}, {"energy", 0, 1e-3}}},
    ALL_DISCS("surface", false),
    ALL_DISCS("pair", true)};
const int contact_cases_count = COUNT_OF(contact_cases);
