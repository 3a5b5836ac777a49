/* Plates: Kalthoff's plate, whose cracks turn, and notched glass, whose crack branches. */
#include <math.h>

#include "experiments.h"

/* Plate of Borden et al. 2012, section 4.1: 100 x 40 mm in plane strain, notched to its middle, under tension of 1 MPa
 * at both long edges. Its Rayleigh speed c_R is 2125 m/s; the crack in the paper stays well below 0.6 c_R. */
static const char borden_text[] =
    "name: borden\nspace: plane strain\nthickness: 1 mm\nduration: 80 us\nmodel: ospd\n"
    "material: {young: 32 GPa, poisson: 0.2, density: 2450, energy_release_rate: 3}\n"
    "body: {box: {from: [0, 0], to: [100 mm, 40 mm]}}\nparticles: {spacing: 0.25 mm}\npd: {normalisation: bulk}\n"
    "cracks: [{from: [-1 mm, 20 mm], to: [50 mm, 20 mm]}]\n"
    "boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]\n"
    "output: {times: [80 us], samples: 200}\n";

#define KALTHOFF "Kalthoff & Winkler 1988"
#define BOWDEN "Bowden et al. 1967"
#define BORDEN "Borden et al. 2012"

#define KALTHOFF_FIGURES                                                                                               \
    {                                                                                                                  \
        {"angle of the cracks", "deg", "crack.angle_deg", NULL, 1, 67, 73, KALTHOFF},                                  \
            {"first bond breaks", "us", "crack.start_time", NULL, 1e6, NAN, NAN, ""},                                  \
            {"largest speed", "m/s", "crack.tip_speed_max", NULL, 1, NAN, NAN, ""},                                    \
        {                                                                                                              \
            "length", "mm", "crack.length_end", NULL, 1e3, NAN, NAN, ""                                                \
        }                                                                                                              \
    }

/* Results of a crack that branches: time of the first break, position and angle of the branches, and their number. */
#define BRANCHES                                                                                                       \
    {"first bond breaks", "us", "crack.start_time", NULL, 1e6, NAN, NAN, ""},                                          \
        {"branches at x", "mm", NULL, branching_x_coordinate, 1e3, NAN, NAN, ""},                                      \
        {"angle between branches", "deg", NULL, branching_angle_in_degrees, 1, NAN, NAN, ""},                          \
    {                                                                                                                  \
        "branches", "", NULL, branching_largest_branch_count, 1, NAN, NAN, ""                                          \
    }
#define GLASS_FIGURES                                                                                                  \
    {                                                                                                                  \
        BRANCHES, {"largest speed", "m/s", "crack.tip_speed_max", NULL, 1, 0, 1580, BOWDEN},                           \
        {                                                                                                              \
            "mean speed", "m/s", "crack.tip_speed_mean", NULL, 1, 0, 1580, BOWDEN                                      \
        }                                                                                                              \
    }
#define BORDEN_FIGURES                                                                                                 \
    {                                                                                                                  \
        BRANCHES, {"largest speed / c_R", "", "crack.tip_speed_max", NULL, 1 / 2125.0, 0, 0.6, BORDEN},                \
        {                                                                                                              \
            "mean speed / c_R", "", "crack.tip_speed_mean", NULL, 1 / 2125.0, 0, 0.6, BORDEN                           \
        }                                                                                                              \
    }

/* Kalthoff's steel, with its toughness of 68 MPa m^0.5 (E 190 GPa, rho 8000 kg/m^3, G_c 22.13 kJ/m^2: Borden et al.
 * 2012, section 4.3), and with the 69 kJ/m^2 of the scene (Zeng et al. 2022), for which the crack hardly grows at these
 * impact speeds. */
#define STEEL                                                                                                          \
    {"material.energy_release_rate", "22.13 kJ/m^2"}, { "material.density", "8000" }
#define KALTHOFF_CASE(speed, variant, until, quick, drawn, finest, runs, ...)                                          \
    {                                                                                                                  \
        "Kalthoff, " speed, variant, "inputs/kalthoff_winkler.yaml", NULL,                                             \
            {{"boundary.0.velocity", "[" speed ", free]"},                                                             \
             {"duration", until},                                                                                      \
             {"output", "{times: [" until "], samples: 200}"},                                                         \
             __VA_ARGS__},                                                                                             \
            {finest, "1 mm"}, {runs, 3}, quick, drawn, KALTHOFF_FIGURES                                                \
    }

static const struct experiment_case plate_cases[] = {
    KALTHOFF_CASE("16.5 m/s", "adaptive", "90 us", true, true, "0.25 mm", 9, STEEL),
    KALTHOFF_CASE("20 m/s", "adaptive", "80 us", true, true, "0.25 mm", 9, STEEL),
    KALTHOFF_CASE("16.5 m/s", "pd", "90 us", false, true, "0.5 mm", 5, STEEL, {"method", "pd"}),
    KALTHOFF_CASE("16.5 m/s", "69 kJ/m2", "90 us", false, false, "0.25 mm", 5, {"method", "adaptive"}),
    KALTHOFF_CASE("20 m/s", "69 kJ/m2", "80 us", false, false, "0.25 mm", 5, {"method", "adaptive"}),
    {"glass, 2 MPa",
     "pd",
     "inputs/glass_branching.yaml",
     NULL,
     {{"output", "{times: [45 us], samples: 200}"}},
     {"0.16666667 mm", "0.5 mm"},
     {9, 3},
     true,
     true,
     GLASS_FIGURES},
    {"glass, 2 MPa",
     "adaptive",
     "inputs/glass_branching.yaml",
     NULL,
     {{"output", "{times: [45 us], samples: 200}"}, {"method", "adaptive"}},
     {"0.16666667 mm", "0.5 mm"},
     {9, 3},
     true,
     true,
     GLASS_FIGURES},
    {"Borden's plate",
     "pd",
     NULL,
     borden_text,
     {{"method", "pd"}},
     {"0.16666667 mm", "0.5 mm"},
     {9, 3},
     true,
     true,
     BORDEN_FIGURES},
    {"Borden's plate",
     "adaptive",
     NULL,
     borden_text,
     {{"method", "adaptive"}},
     {"0.16666667 mm", "0.5 mm"},
     {9, 3},
     true,
     true,
     BORDEN_FIGURES},
    {"Borden's plate",
     "ad. local",
     NULL,
     borden_text,
     {{"method", "adaptive"}, {"pd.normalisation", "local"}},
     {"0.25 mm", "0.5 mm"},
     {5, 3},
     false,
     true,
     BORDEN_FIGURES},
};

status experiments_run_plates(struct experiments *x)
{
    for (size_t k = 0; k < COUNT_OF(plate_cases); k++) TRY(experiment_make_convergence_study(x, &plate_cases[k]));
    return OK;
}
