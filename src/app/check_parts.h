/* The parts of `cleave check`: the measured cost of a run, and advice. */
#ifndef CLEAVE_CHECK_PARTS
#define CLEAVE_CHECK_PARTS

#include <stdio.h>

#include "arguments.h"
#include "engine/engine.h"

/* ---- check_cost.c ------------------------------------------------------------------------------------------------ */

/* Basis of the time of a run. TRIED: all of its steps. SCALED: its first steps, times the ratio of all steps to the
 * first ones in the same scene with larger particles. FIRST: its first steps alone, too little where many particles
 * convert. */
enum cost_basis { COST_TRIED, COST_SCALED, COST_FIRST };

/* Quartiles of measured times [s]. */
struct quartiles {
    double lower, median, upper;
};

struct cost {
    double make;                /* from the scene to step 0; by the caller [s] */
    double step;                /* a first step, samples included, whole body active; static: an iteration;
                                   load steps: an equilibrium [s] */
    double spread;              /* of windows of such steps: largest ratio of a quartile to the median [1] */
    double contact;             /* share of contact in such a step, whatever touches then */
    double output;              /* frames and checkpoints, on an idle disk [s] */
    double run;                 /* whole run [s] */
    double least, most;         /* between which it is; most INFINITY: not known [s] */
    double equilibria;          /* load steps: how many at the most */
    real overload, overload_at; /* ... of bonds at the worst load time, were none broken; that time [s] */
    enum cost_basis basis;
    double coarser, growth; /* SCALED: factor on the spacing; all steps over first ones [1] */
    double all_peridynamic; /* a run with all particles peridynamic [s]; NAN: not adaptive, or too large */
    double bytes;           /* peak memory of a run without conversion [byte] */
    struct warnings found;  /* by the trial steps of this scene, of all of them if they were taken */
};

/* Takes steps and times them, with the current team; the engine cannot be used afterwards. `a`: the arguments of its
 * scene. FAILED if one of the first steps fails. */
status cost_measure(struct cost *c, struct run *e, const struct run_arguments *a);

/* ---- check_steps.c ----------------------------------------------------------------------------------------------- */

/* Load steps: the solver and what leads cracks; advice; the cost, by the first equilibrium: FAILED where there is none;
 * the line about it. */
void say_load_steps(const struct run *e);
void advise_load_steps(const struct run *e, FILE *out);
status cost_load_steps(struct cost *c, struct run *e);
void say_load_steps_cost(const struct run *e, const struct cost *c, int threads);

/* ---- check_shapes.c ---------------------------------------------------------------------------------------------- */

/* Files that solids are made of: closed or open, what they enclose. */
void say_shapes(const struct run *e);

/* Bodies in several pieces that no bond joins (check_pieces.c). */
void say_pieces(const struct run *e);

/* ---- check_layers.c ---------------------------------------------------------------------------------------------- */

/* Smallest edge, mirror images included, diameter or wall of a solid [m]; INFINITY: it has none (check_advice.c). */
real solid_size(const struct run *e, const struct solid *a);
/* Layers of particles across the thin parts of a body and those joined to it; INFINITY: less than half of it is
 * thinner than `most` layers, or the body is joined to another, which is asked in its place. */
double check_layers(const struct run *e, int body, double most);
/* Bodies that nearly keep their volume, whose families or cells are too stiff. */
void advise_incompressible(const struct run *e, FILE *out);

/* ---- check_levels.c ---------------------------------------------------------------------------------------------- */

/* Coarse cells: how large, how many and why; what they save. */
void say_levels(const struct run *e);
void say_levels_saving(const struct run *e, const struct cost *c);

/* ---- check_sections.c -------------------------------------------------------------------------------------------- */

/* Writes a line for each narrow part whose sections hold too many or too few particles, and spacings that divide it. */
void advise_sections(const struct run *e, FILE *out);
/* Writes a length to `digits` digits, in the largest unit in which the present spacing is not below 0.1. */
struct length_text {
    char text[32];
};
struct length_text length_in_words(real length, int digits, real spacing);

/* ---- check_loads.c ----------------------------------------------------------------------------------------------- */

/* Loads and supports: particles, areas, forces and moments. */
void say_loads(const struct run *e);

/* Share of the area of a load's or support's face that looks elsewhere than along its axis, by which angle, and the
 * region that leaves it out (check_faces.c). */
void say_elsewhere(const struct run *e, const struct boundary *b);

/* Volume of the particles of bodies that are not boxes, beside that of their shapes (check_filled.c). */
void say_filled(const struct run *e);

/* ---- check_advice.c ---------------------------------------------------------------------------------------------- */

/* Writes a line for each part of the scene that limits its accuracy: what, by how much, and what to do. The run has
 * taken no step. */
void advise(const struct run *e, FILE *out);

/* Adds a line for each part of the scene that costs more than it has to, and for ends of cracks that lie on bonds. The
 * run has taken no step. */
void hints_find(const struct run *e, struct warnings *to);

/* How far the stiffness of a part of so many layers is off, with a rule for families near faces [%]. */
int stiffness_error(const struct scene *s, enum surface_rule surface, double layers);
/* Thin parts of bodies from lists that are no lattice (check_lists.c). */
void advise_lists(const struct run *e, FILE *out);
/* True if the scene equals its mirror image in the plane across `axis` through the middle of its particles, at *at [m]
 * (check_symmetry.c). */
bool scene_is_mirrored(const struct run *e, int axis, real *at);

#endif
