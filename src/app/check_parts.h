/* Declares the parts of `cleave check`: the measured cost of a run, descriptions and advice. Functions print_* print to
 * standard output or to a file `out`; functions print_advice_* write lines with remarks to `out`; functions hint_* add
 * lines to a list of warnings. */
#ifndef CLEAVE_CHECK_PARTS
#define CLEAVE_CHECK_PARTS

#include <stdio.h>

#include "arguments.h"
#include "engine/engine.h"

/* Least relative error [1] of a length, area or volume, as the particles fill it, that is reported. Loads, stiffnesses
 * and masses have an equal error. Errors below 2 % are smaller than the errors of stress-intensity factors at usual
 * resolution, so that changing the spacing for them has no use. */
#define OFF_LEAST 0.02

/* ---- check_cost.c ------------------------------------------------------------------------------------------------ */

/* Basis of the estimated run time. COST_TRIED: all steps were done and measured. COST_SCALED: the first steps were
 * measured, and the growth of the time of later steps in an equal scene with larger particles. COST_FIRST: the first
 * steps alone, which underestimates the time if many particles convert. */
enum cost_basis { COST_TRIED, COST_SCALED, COST_FIRST };

/* Lower quartile, median and upper quartile of a set of measured times [s]. */
struct quartiles {
    double lower, median, upper;
};

/* Estimated cost of a run; times are processor time of one thread. */
struct cost {
    double make;        /* set-up of the run, from the scene to step 0; measured by the caller [s] */
    double step;        /* a first step with the whole body active, samples included; static: an iteration; load steps:
                           an equilibrium [s] */
    double spread;      /* over windows of such steps: largest ratio of a quartile to the median [1] */
    double contact;     /* share of contact in the time of such a step, however many particles touch then [1] */
    double output;      /* writing of frames and checkpoints, on an idle disk [s] */
    double run;         /* whole run [s] */
    double least, most; /* lower and upper bound of `run`; most INFINITY: not known [s] */
    double equilibria;  /* load steps: largest number of equilibria */
    /* largest ratio of stretch to critical stretch of the intact body [1]; its pseudo-time [s] */
    real overload, overload_at;
    enum cost_basis basis; /* how `run` was estimated */
    double coarser,
        growth; /* SCALED: factor on the spacing; time of all steps divided by that expected from the first [1] */
    double all_peridynamic;     /* time of a run with all particles peridynamic [s]; NAN: not adaptive, or too large */
    double bytes;               /* peak memory of a run without conversion [byte] */
    int64_t particles_at_start; /* number of particles before the first trial step */
    struct warnings found;      /* warnings of the trial steps of this scene */
};

/* Estimates the cost c (time and memory) of a run by trial steps, on the number of OpenMP threads that is set. a:
 * arguments by which the input file was read, so that variants of it can be run for comparison. The run cannot be used
 * afterwards. Returns FAILED if one of the first steps fails. */
status run_cost_measure_by_trial_steps(struct cost *c, struct run *run, const struct run_arguments *a);

/* ---- check_strength.c -------------------------------------------------------------------------------------------- */

/* Prints, for a material m of scene s (the input file) whose bonds soften, its strengths, its softening law and the
 * largest or smallest horizon that these allow. Prints nothing for other materials. */
void print_softening_and_horizon_limits(const struct scene *s, const struct material *m);

/* Prints the tensile strength that follows from the critical stretch of brittle bonds of material m at the horizon of
 * scene s (the input file), Young's modulus times critical stretch, as a part of a sentence. Prints nothing for other
 * models than the bond-based one, and for materials that yield. */
void print_tensile_strength_of_brittle_bonds(const struct scene *s, const struct material *m);

/* Size of a part of a body, or length of a crack [horizons], below which the two faces of the part, or the two tips of
 * the crack, affect each other. */
#define FEATURE 4

/* ---- check_precracks.c ------------------------------------------------------------------------------------------- */

/* Prints the length of the smallest pre-crack of the run and its ratio to the horizon. Prints nothing unless the body
 * is plane and its bonds soften. */
void print_smallest_resolvable_precrack_length(const struct run *run);

/* Writes a remark to `out` for each 2D crack of scene s (the input file) whose two tips are less than FEATURE (4)
 * horizons apart, so that they affect each other. A crack that begins at a face or a plane of symmetry has one tip. It
 * counts as half of a crack of twice its length. fracture: holds the crack tips. */
void print_advice_on_close_crack_tips(const struct scene *s, const struct fracture_state *fracture, FILE *out);

/* Adds a hint to *warning_list for each 2D pre-crack of the run that ends exactly on bonds, so that rounding decides
 * whether it cuts them. */
void hint_precrack_ends_exactly_on_bonds(const struct run *run, struct warnings *warning_list);

/* ---- check_steps.c ----------------------------------------------------------------------------------------------- */

/* Prints to standard output the number, control and tolerance of the load steps (successive static equilibria) of the
 * run, and the rule by which cracks grow if bonds can break. */
void print_load_step_settings(const struct run *run);

/* Writes a line to `out` for each setting of loads, supports or lengths of cracks of the run that reduces the accuracy
 * of load steps (successive static equilibria). */
void print_load_step_accuracy_advice(const struct run *run, FILE *out);

/* Estimates the cost of a run with load steps (successive static equilibria) from the time of its first equilibrium,
 * into *c. The run cannot be continued afterwards. Returns FAILED if no equilibrium is found. */
status load_steps_estimate_run_cost(struct cost *c, struct run *run);

/* Prints the estimated run time of load steps (successive static equilibria) with `threads` threads, and a line if no
 * bond will break. cost: the estimate for the run. */
void print_load_steps_cost(const struct run *run, const struct cost *cost, int threads);

/* ---- check_shapes.c ---------------------------------------------------------------------------------------------- */

/* Prints for each file from which the input file of the run reads a solid whether its surface is closed, and the volume
 * that the surface encloses. */
void print_shape_file_volumes(const struct run *run);

/* Prints a line for each body of the run that consists of several pieces without bonds between them (check_pieces.c).
 */
void print_bodies_in_several_unbonded_pieces(const struct run *run);

/* ---- check_layers.c ---------------------------------------------------------------------------------------------- */

/* Returns the smallest edge, diameter or wall thickness [m] of the solid `solid`. An edge that ends at a plane of
 * symmetry of the run counts with its mirror image. Returns INFINITY if the solid has none of these. */
real solid_smallest_edge(const struct run *run, const struct solid *solid);

/* Returns the number of particle layers across the thin parts of body number `body_index` of the run, together with the
 * bodies that interfaces join to it; INFINITY if it is not thin. A body of a single solid is thin if its smallest edge
 * is less than `max_layers` spacings; this number of spacings is returned. Any other body is thin if across at least
 * half of its particles it has fewer layers than max_layers / 2; the median number of layers there is returned. Returns
 * INFINITY for a body that is joined to a body of lower index. */
double count_particle_layers_across_thin_parts(const struct run *run, int body_index, double max_layers);

/* Writes a line to `out` for each body of run of nearly incompressible material whose particles near faces are too
 * stiff, or whose mesh cells are too soft, in bending. */
void print_advice_on_incompressible_bodies(const struct run *run, FILE *out);

/* Writes a line to `out` for each support of the run that prescribes the motion of a layer of particles behind a face,
 * a horizon deep by default, if this layer stiffens a body of bonds in equilibrium by more than a few percent. */
void print_advice_on_stiffening_by_prescribed_motion(const struct run *run, FILE *out);

/* ---- check_levels.c ---------------------------------------------------------------------------------------------- */

/* Prints size and number of the coarse mesh cells of the run (larger cells, in which no particles are made), and why
 * they are used or not. */
void print_coarse_cell_sizes_and_counts(const struct run *run);

/* Prints the memory and time that coarse cells of the mesh (larger cells, in which no particles are made) save in the
 * run e. cost: measured cost of the run. */
void print_cost_saved_by_coarse_cells(const struct run *run, const struct cost *cost);

/* ---- check_sections.c -------------------------------------------------------------------------------------------- */

/* Writes a line to `out` for each narrow part of a body of the run whose width is no whole number of spacings, so that
 * the particles make it too wide or too narrow. The line states the nearest spacings that divide the width. */
void print_advice_on_widths_of_narrow_parts(const struct run *run, FILE *out);

/* Writes a line to `out` for each body of run of material points on the background grid that starts apart from a
 * plane of symmetry, with the distance [m] from the plane at which the grid stops the body (check_walls.c). */
void print_advice_on_gaps_to_mirror_planes(const struct run *run, FILE *out);

/* Text of a length with its unit, for messages; a struct, so that functions can return it by value. */
struct length_text {
    char text[32];
};

/* Returns `length` [m] as text with `digits` digits, in the largest unit (m, mm, ...) in which the number for `spacing`
 * [m] is at least 0.1. */
struct length_text length_text_with_unit(real length, int digits, real spacing);

/* ---- check_loads.c ----------------------------------------------------------------------------------------------- */

/* Prints a line for each load and support of the run: its number of particles, area, force and moment. */
void print_loads_and_supports(const struct run *run);

/* Writes a line to `out` if the loads on a single body of the run do not balance along an axis along which no support
 * holds it, and act until the end of the run. The line states the velocity and the displacement that the body gains by
 * them, and a remedy. */
void print_advice_on_unbalanced_loads(const struct run *run, FILE *out);

/* Prints for the loaded or supported face of boundary b of the run: the fraction of its area that is not
 * perpendicular to the axis of the boundary, the mean angle between normal and axis there, and a region that excludes
 * this part of the face. If the face lies in several planes and the boundary has no region, prints instead where it
 * lies. */
void print_fraction_of_loaded_face_not_normal_to_axis(const struct run *run, const struct boundary *b);

/* Prints the volume of the particles and the volume of the shape for those bodies of the run that are not boxes
 * (check_filled.c). */
void print_volume_filled_by_particles(const struct run *run);

/* ---- check_idle.c ------------------------------------------------------------------------------------------------ */

/* Adds one line to *warning_list with those keys of scene s (the input file) that have no effect in it. Adds further
 * lines for materials of which no body consists, and for fracture criteria in runs without bonds. Adds no line about
 * keys if the input file gives all keys, as the file scene.yaml of a run does. */
void hint_keys_without_effect(const struct scene *s, struct warnings *warning_list);

/* ---- check_signs.c ----------------------------------------------------------------------------------------------- */

/* Adds a line to *warning_list for each load of the run whose sign is probably not intended, and for each setting whose
 * size is probably not intended. */
void hint_implausible_load_signs_and_magnitudes(const struct run *run, struct warnings *warning_list);

/* ---- check_advice.c ---------------------------------------------------------------------------------------------- */

/* Writes to `out` a line for each property of the input file that limits the accuracy of the run, with the size of
 * the error and a remedy. The run must not have taken a step. */
void print_accuracy_advice(const struct run *run, FILE *out);

/* Writes to `out` by how much the stiffness of a part of scene s (the input file) with a thickness of
 * `particle_layer_count` particle layers differs at most from that of the material, for example "about 2 % in bending
 * and tension"; in 3D also in torsion. The values are from a table. surface: correction of bonds near faces. */
void print_stiffness_error_of_thin_part(const struct scene *s, enum surface_rule surface, double particle_layer_count,
                                        FILE *out);

/* Writes lines about inexact stiffness to `out` for those bodies of the peridynamic run whose particles are read from
 * a list: bodies whose list is no lattice along the axes although `pd.weights: isotropic` assumes one, and, without
 * `pd.surface: moments`, bodies with parts of less than 16 layers of particles. Writes nothing for other methods and in
 * 1D. */
void print_stiffness_advice_on_particle_list_bodies(const struct run *run, FILE *out);

/* Returns true if the set-up of the run (bodies, loads, cracks) equals its mirror image in the plane normal to axis
 * `normal_axis` through the middle of its particles. *plane_position receives the position of this plane along the axis
 * [m] (check_symmetry.c). */
bool run_is_symmetric_about_mid_plane(const struct run *run, int normal_axis, real *plane_position);

/* ---- check_hints.c ----------------------------------------------------------------------------------------------- */

/* Adds a line to *warning_list for each setting of the input file of the run that costs more than necessary or has no
 * effect, and for each end of a crack that is exactly on bonds. The run must not have taken a step. */
void hint_needless_cost_and_unused_settings(const struct run *run, struct warnings *warning_list);

#endif
