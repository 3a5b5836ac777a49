/* Cases of `cleave bench contact`: closed forms and the required ranges around them. */
#include <math.h>

#include "contact_bench.h"

#define BOTH(...)                                                                                                      \
    {.law = "surface", __VA_ARGS__}, { .law = "pair", __VA_ARGS__ }

/* Cases of two equal bars of n particles that collide at v wave speeds, one case for each contact law. least:
 * required restitution; longest: largest duration over 2 L/c; short_: true if the case is known to miss these. The
 * restitution grows with the number of particles: bars of 200 particles with softer contact do not reach 0.99. */
#define BARS(n, v, least, longest, short_)                                                                             \
    BOTH(.name = "equal bars, " #n " particles, " #v " c", .measure = contact_measure_bar_collision,                   \
         .given = {n, n, v, -v}, .falls_short = short_,                                                                \
         .asked = {{"restitution", least, 1.001}, {"duration", 1, longest}, {"force", 0, 2.1}, {"energy", 0, 1e-3}})
#define STRIKER(n, off)                                                                                                \
    BOTH(.name = "striker on twice its length, " #n " particles", .measure = contact_measure_striker_bar,              \
         .given = {n, 2 * n, 1e-3, 0},                                                                                 \
         .asked = {{"striker", -off, off}, {"struck", 0.5 - off, 0.5 + off}, {"energy", 0, 1e-3}})

/* Case of a block that is cut through, compressed by `strain` and sheared by `shear` spacings. least, most: required
 * normal force over that of the intact block; along: largest tangential force over the same. The tangential force is
 * 0.7 % of the pressure, seven times the shear force of the intact block. For an opened cut the limits allow the
 * residual vibrations in the mean over time. */
#define BLOCK(what, n, strain, shear, least, most, along)                                                              \
    {                                                                                                                  \
        .name = "cut block, " #n " rows, " what, .measure = contact_measure_cut_block, .given = {n, strain, shear},    \
        .law = "surface", .asked = {                                                                                   \
            {"force over whole", least, most},                                                                         \
            {"along", 0, along}                                                                                        \
        }                                                                                                              \
    }
#define PAIR_BLOCK(what, n, strain, shear, least, most, along, short_)                                                 \
    {                                                                                                                  \
        .name = "cut block, " #n " rows, " what, .measure = contact_measure_cut_block, .given = {n, strain, shear},    \
        .law = "pair", .falls_short = short_, .asked = {                                                               \
            {"force over whole", least, most},                                                                         \
            {"along", 0, along}                                                                                        \
        }                                                                                                              \
    }
#define BALL(R, v)                                                                                                     \
    {                                                                                                                  \
        .name = "ball on a plane, R " #R ", " #v " c", .law = "surface", .measure = contact_measure_ball_on_plane,     \
        .given = {R, v}, .long_run = true, .asked = {                                                                  \
            {"exponent", 1.45, 1.55},                                                                                  \
            {"duration", 0.9, 1.1},                                                                                    \
            {"restitution", 0.9, 1},                                                                                   \
            {"energy", 0, 1e-3}                                                                                        \
        }                                                                                                              \
    }

/* Case of two discs of radius 20 spacings that stick, with an impact parameter of b radii and a lattice rotated by
 * `turn` [rad]. Discs that stick roll on each other: 2/3 of the tangential velocity remains, and a spin of the same
 * size. Elastic discs separate while the tangential spring oscillates, and differ by up to 0.08. sine: exact spin over
 * 2/3. */
#define STICKING(b, sine, turn)                                                                                        \
    {                                                                                                                  \
        .name = "discs, R 20, 0.01 c, b " #b " R, turn " #turn ", friction 10", .law = "surface, friction: 10",        \
        .measure = contact_measure_disc_collision, .given = {20, 1e-2, b, turn}, .falls_short = true, .asked = {       \
            {"normal", 0.85, 1.03},                                                                                    \
            {"tangential", 2 / 3. - 0.05, 2 / 3. + 0.05},                                                              \
            {"spin", sine * 2 / 3 - 0.05, sine * 2 / 3 + 0.05},                                                        \
            {"energy", 0, 5e-3}                                                                                        \
        }                                                                                                              \
    }

/* Case of a block on a slope with the tangent `tan` and the coefficient of friction mu. Required: acceleration within
 * 0.1 g sin of the exact one; a block at rest moves by less than 0.2 spacings. The energy balance of a block that
 * sticks to a rigid floor scatters with slope and kernels: 0.0067 +- 0.0021, at most 0.0103, on slopes of 0.6 to 0.8
 * with two kernel sets; its limit allows four standard deviations. */
#define SLOPE(tan, mu, rigid, on)                                                                                      \
    {                                                                                                                  \
        .name = "block on a " on ", tan " #tan ", friction " #mu, .law = "surface",                                    \
        .measure = contact_measure_sliding_block, .given = {tan, mu, rigid}, .asked = {                                \
            {"g sin", (tan > mu ? 1 - mu / (tan) : 0) - 0.1, (tan > mu ? 1 - mu / (tan) : 0) + 0.1},                   \
            {"way", tan > mu ? 5 : -0.2, tan > mu ? 50 : 0.2},                                                         \
            {"energy", 0, rigid && mu > 1 ? 1.5e-2 : 1e-2}                                                             \
        }                                                                                                              \
    }
#define SLOPES(rigid, on)                                                                                              \
    SLOPE(0.2, 0, rigid, on), SLOPE(0.4, 0, rigid, on), SLOPE(0.7, 0, rigid, on), SLOPE(0.2, 0.3, rigid, on),          \
        SLOPE(0.4, 0.3, rigid, on), SLOPE(0.7, 0.3, rigid, on), SLOPE(0.7, 10, rigid, on)

/* Case of two discs of radius R spacings that collide at v wave speeds without friction, with an impact parameter of
 * b radii. turn: rotation of the lattice against the line of centres [rad]; with 0 the velocities are along the
 * lattice. short_: true if the case is known to miss the required ranges. */
#define DISCS(law_, R, v, b, turn, short_)                                                                             \
    {                                                                                                                  \
        .name = "discs, R " #R ", " #v " c, b " #b " R, turn " #turn, .law = law_,                                     \
        .measure = contact_measure_disc_collision, .given = {R, v, b, turn}, .falls_short = short_,                    \
        .long_run = R > 20, .asked = {                                                                                 \
            {"normal", b > 0 ? 0.85 : 0.97, 1.03},                                                                     \
            {"tangential", 0.95, 1.05},                                                                                \
            {"spin", b > 0 ? -0.1 : -1e-6, b > 0 ? 0.1 : 1e-6},                                                        \
            {"energy", 0, 5e-3}                                                                                        \
        }                                                                                                              \
    }
#define ALL_DISCS(law_, short_)                                                                                        \
    DISCS(law_, 20, 1e-3, 0, 0, short_), DISCS(law_, 20, 1e-2, 0, 0, short_), DISCS(law_, 20, 5e-2, 0, 0, short_),     \
        DISCS(law_, 20, 1e-2, 1, 0, short_), DISCS(law_, 20, 1e-2, 1.5, 0, short_),                                    \
        DISCS(law_, 20, 1e-2, 1, 0.5236, short_), DISCS(law_, 20, 1e-2, 1.5, 0.8481, short_),                          \
        DISCS(law_, 40, 1e-2, 1, 0.5236, short_), DISCS(law_, 40, 1e-2, 1.5, 0.8481, short_)

const struct contact_case contact_cases[] = {BARS(100, 1e-3, 0.98, 1.05, false),
                                             BARS(200, 1e-3, 0.99, 1.03, true),
                                             BARS(100, 2e-2, 0.98, 1.05, false),
                                             STRIKER(100, 0.02),
                                             STRIKER(200, 0.01),
                                             {.name = "ten bounces between walls, 50 x 10",
                                              .law = "surface",
                                              .measure = contact_measure_bouncing_bar,
                                              .given = {50, 10, 2e-3},
                                              .falls_short = true,
                                              .asked = {{"energy", 0, 1e-3}, {"momentum", 0, 1e-12}}},
                                             BLOCK("strain -1e-3", 24, 1e-3, 1e-6, 0.84, 1, INFINITY),
                                             BLOCK("strain -1e-3", 48, 1e-3, 1e-6, 0.92, 1, INFINITY),
                                             BLOCK("opened", 24, -1e-3, 1e-6, -2e-3, 2e-3, INFINITY),
                                             BLOCK("strain -5e-3, sheared", 24, 5e-3, 0.05, 0.84, 1, 0.05),
                                             PAIR_BLOCK("strain -1e-3", 24, 1e-3, 1e-6, 0.84, 1, INFINITY, false),
                                             PAIR_BLOCK("strain -5e-3, sheared", 24, 5e-3, 0.05, 0.84, 1, 0.05, true),
                                             SLOPES(1, "rigid floor"),
                                             SLOPES(0, "floor of its own"),
                                             BALL(20, 5e-2),
                                             BALL(24, 3e-2),
                                             ALL_DISCS("surface", false),
                                             STICKING(1, 0.5, 0),
                                             STICKING(1.5, 0.75, 0),
                                             STICKING(1, 0.5, 0.5236),
                                             ALL_DISCS("pair", true)};
const int contact_cases_count = COUNT_OF(contact_cases);
