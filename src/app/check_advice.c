/* Writes remarks on what limits the accuracy of an input file before it is run.
 * No remark is an error. Limits and their basis:
 *
 *   feature      a peridynamic part thinner than FEATURE horizons is mostly surface, whose particles lack
 *                neighbours. The error of its stiffness was measured with strips and bars in pure bending,
 *                tension and torsion. Lowest frequencies (`cleave bench accuracy=beam`, `=rod`) err half as much
 *   wave         a front or pulse shorter than WAVE spacings disperses: an interface reflects 2 % of a pulse
 *                of 16 spacings; the group velocity of the shortest waves errs by a tenth
 */
#include <math.h>

#include "check_parts.h"
#include "fracture/fracture_part.h"
#include "fracture/tips.h"
#include "probes/probes_part.h"
#include "mesh/mesh_part.h"
#include "step/parted.h"
#include "step/shock.h"

#define ENOUGH 0.99      /* share of FEATURE horizons that is tolerated: 12 spacings are 3.98 horizons */
#define WAVE 16          /* shortest front or pulse of which no remark is made [spacings] */
#define BESIDE_FACE 1.5  /* largest distance at which a probe counts as at a face [spacings] */
#define AROUND 3         /* distance around a probe within which its face is searched [spacings] */
#define ALONG_AXIS 0.999 /* least component of a normal for which a face counts as aligned with the axes */
enum { PULL_MOMENTS = 100, PULL_PLACES = 64 }; /* numbers of times, and of particles of a support, that are evaluated */
#define ON_MIRROR 1e-6                         /* largest distance of a face on a plane of symmetry [spacings] */
static real horizon_of(const struct scene *s) { return s->horizon * s->spacing; }

/* ---- parts that are not resolved --------------------------------------------------------------------------------- */

/* Returns the edge length of the box `a` along axis d [m]: doubled if one end of the box is within ON_MIRROR spacings
 * of a plane of symmetry of `source`, and INFINITY if both ends are. scene: has the spacing. */
static real mirrored_edge(const struct scene *scene, const struct bond_source *source, const struct solid *a, int d)
{
    const real near = ON_MIRROR * scene->spacing;
    bool from = false, to = false;
    for (int k = 0; k < source->mirrors; k++) {
        if (source->mirror[k].axis != d) continue;
        from |= fabs(source->mirror[k].at - a->from[d]) < near;
        to |= fabs(source->mirror[k].at - a->to[d]) < near;
    }
    return from && to ? INFINITY : (from || to ? 2 : 1) * (a->to[d] - a->from[d]);
}

real solid_smallest_edge(const struct run *run, const struct solid *solid)
{
    real least = INFINITY;
    for (int d = 0; d < run->scene->dim && solid_is_untransformed_and_of_kind(solid, SOLID_BOX); d++)
        least = real_min(least, mirrored_edge(run->scene, &run->source, solid, d));
    return real_min(least, solid_least_thickness(solid, run->scene->dim));
}

/* Largest relative error of the stiffness of a thin peridynamic part [%] by its number of particle layers: in 2D and in
 * 3D in bending and tension, in 3D in twisting. Measured as test_check_layers.sh does, in pure bending, tension and
 * torsion of strips and square bars of 8 to 1 at a horizon of 3.015 spacings: `bond` at the Poisson's ratio of bonds,
 * `ospd` and `mospd` at ratios from 0 to 1/3, `uncorrected` for bonds with pd.surface: none. The first row applies to
 * all thinner parts, the last row to all thicker ones. */
enum { OFF_PLANE, OFF_SOLID, OFF_TWISTED, OFFS }; /* columns of the table; OFFS: their number */
static const struct {
    double layers;
    int bond[OFFS], ospd[OFFS], mospd[OFFS], uncorrected[OFFS];
} stiffness_off[] = {
    {3, {80, 80, 80}, {80, 85, 80}, {74, 67, 67}, {80, 80, 80}},
    {4, {4, 6, 27}, {6, 6, 27}, {34, 39, 26}, {36, 46, 61}},
    {5, {2, 3, 15}, {5, 4, 15}, {22, 10, 26}, {29, 39, 50}},
    {7, {1, 2, 14}, {4, 3, 14}, {7, 9, 9}, {23, 30, 37}},
    {10, {1, 1, 7}, {4, 3, 7}, {4, 5, 2}, {17, 22, 27}},
};
#define USUAL_HORIZON 0.5 /* largest difference of the horizon from 3.015 for this table [spacings] */

/* Returns from a table the largest relative errors of the stiffness of a peridynamic part that is `layers` particles
 * thick, with the bond model of scene s (the input file). The three errors [%] are indexed by OFF_PLANE (2D), OFF_SOLID
 * (3D in bending and tension) and OFF_TWISTED (3D in torsion). surface: rule by which the weights of bonds near faces
 * are corrected. */
static const int *stiffness_errors(const struct scene *s, enum surface_rule surface, double layers)
{
    size_t row = 0;
    while (row + 1 < COUNT_OF(stiffness_off) && layers > stiffness_off[row + 1].layers - 0.5) row++;
    if (surface != SURFACE_MOMENTS) return stiffness_off[row].uncorrected;
    return s->model == MODEL_BOND   ? stiffness_off[row].bond
           : s->model == MODEL_OSPD ? stiffness_off[row].ospd
                                    : stiffness_off[row].mospd;
}

void print_stiffness_error_of_thin_part(const struct scene *s, enum surface_rule surface, double particle_layer_count,
                                        FILE *out)
{
    const int *off = stiffness_errors(s, surface, particle_layer_count);
    if (s->dim < 3)
        fprintf(out, "about %d %% in bending and tension", off[OFF_PLANE]);
    else
        fprintf(out, "about %d %% in bending and tension, %d %% in twisting", off[OFF_SOLID], off[OFF_TWISTED]);
}

/* Writes to `out`, as part of a remark, the largest error of the stiffness of a peridynamic part of scene s (the input
 * file) that is `layers` particles thick; below 1.5 layers, that it has no bending stiffness. */
static void advise_thin(const struct scene *s, double layers, FILE *out)
{
    if (layers < 1.5) {
        fprintf(out, "; a single layer has no bending stiffness, and its stiffness in tension is off by up to %d %%",
                stiffness_errors(s, s->surface, layers)[s->dim < 3 ? OFF_PLANE : OFF_SOLID]);
        return;
    }
    fprintf(out, "; its stiffness is off by up to ");
    print_stiffness_error_of_thin_part(s, s->surface, layers, out);
    fprintf(out, "%s",
            fabs(s->horizon - 3.015) <= USUAL_HORIZON ? ""
            : s->model == MODEL_MOSPD ? " at a horizon of 3.015 spacings, several times as much at others"
                                      : " at a horizon of 3.015 spacings, more at longer ones");
    fprintf(out, "; in bending, method: adaptive is within 1 %% from 10 layers on");
}

/* Returns the positive number `value` rounded down to two significant digits, with a tolerance for round-off, for
 * messages. */
static real two_digits_down(real value)
{
    const real digit = pow(10, floor(log10(value)) - 1);
    return floor(value / digit + 1e-6) * digit;
}

/* Writes a remark to `out` for each body of the run with a part that is thinner than FEATURE horizons. Most particles
 * of such a part are near a surface and lack neighbours within the horizon. Writes nothing for input files with the
 * method mpm (no bonds), and in 1D. */
static void advise_features(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    for (int b = 0; b < s->bodies && s->dim > 1 && s->method != METHOD_MPM; b++) {
        const double layers = count_particle_layers_across_thin_parts(run, b, ENOUGH * FEATURE * s->horizon),
                     size = layers * s->spacing;
        if (!isfinite(layers)) continue;
        fprintf(out,
                "accuracy       body %s: a part is %.4g m thick, which is %.3g horizons (%.3g spacings); below %d "
                "horizons most particles lack neighbours beyond a face; use a spacing of %s",
                s->body[b].name, size, size / horizon_of(s), layers, FEATURE,
                length_text_with_unit(two_digits_down(size / (FEATURE * s->horizon)), 2, s->spacing).text);
        if (s->method == METHOD_PD) advise_thin(s, layers, out);
        fprintf(out, "\n");
    }
}

/* Writes a remark to `out` for each solid that is subtracted from a body of the run and is thinner than one spacing.
 * Such a hole cuts bonds but removes no row of particles. Solids from voxel images and bodies from particle lists are
 * skipped, as their thickness is not known; also 1D input files. */
static void advise_narrow_holes(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    for (int b = 0; b < s->bodies && s->dim > 1; b++) {
        const struct region *shape = &s->body[b].shape;
        for (int k = 1; k < shape->n && !s->body[b].file; k++) {
            const real size = shape->solid[k].subtract ? solid_smallest_edge(run, &shape->solid[k]) : INFINITY;
            if (size >= s->spacing) continue;
            fprintf(out,
                    "accuracy       body %s: solid %d of its shape, which is subtracted, is only %.3g m thin (spacing "
                    "%.3g m), so it acts as a slit without width between the particles on both sides; use a spacing of "
                    "%s to resolve it\n",
                    s->body[b].name, k + 1, size, s->spacing,
                    length_text_with_unit(two_digits_down(size / 4), 2, s->spacing).text);
        }
    }
}

/* Returns true if the point X[dim] [m] is within BESIDE_FACE spacings of a face of `shape` that is curved or slanted to
 * the axes of scene s. The normals of the shape are evaluated at the points AROUND spacings from X along each axis. The
 * face is curved or slanted if a normal near the face is parallel to no axis. */
static bool at_stepped_face(const struct scene *s, const struct region *shape, const real *X)
{
    real normal[DIM_MAX] = {0};
    bool stepped = false;
    if (fabs(region_signed_distance(shape, X, s->dim, normal)) > BESIDE_FACE * s->spacing) return false;
    for (int k = 0; k < 2 * s->dim; k++) {
        real beside[DIM_MAX] = {0}, most = 0;
        for (int d = 0; d < s->dim; d++) beside[d] = X[d] + (d == k / 2 ? (k % 2 ? 1 : -1) * AROUND * s->spacing : 0);
        const real far = fabs(region_signed_distance(shape, beside, s->dim, normal));
        for (int d = 0; d < s->dim; d++) most = real_max(most, fabs(normal[d]));
        stepped |= far < AROUND * s->spacing && most < ALONG_AXIS;
    }
    return stepped;
}

/* Writes a remark to `out` for each point probe (time series at a position) of scene s at a curved or slanted face of a
 * body, where material points misjudge the stress. Writes nothing in 1D and for the method pd. The error in the text
 * was measured with the elliptic membrane LE1 of NAFEMS, with 20 to 80 points across. */
static void advise_faces(const struct scene *s, FILE *out)
{
    for (int k = 0; k < s->probes && s->method != METHOD_PD && s->dim > 1; k++)
        for (int b = 0; b < s->bodies && s->probe[k].kind == PROBE_POINT; b++) {
            const struct region *shape = &s->body[b].shape;
            if (s->body[b].file || shape->n == 0 || region_has_box_with_infinite_side(shape, s->dim)) continue;
            if (at_stepped_face(s, shape, s->probe[k].at))
                fprintf(out,
                        "accuracy       probe %s: it is at a curved or slanted face of body %s, which the lattice "
                        "turns into steps, so its stress is about 10 %% too low (displacements are right); put it a "
                        "few spacings inside\n",
                        s->probe[k].name, s->body[b].name);
        }
}

/* Returns the rise time of the function of time f: the duration of a pulse or the time of a ramp [s]; INFINITY for
 * other functions. */
static real rise_time(const struct time_function *f)
{
    return f->kind == TIME_PULSE || f->kind == TIME_RAMP ? f->until - f->from : INFINITY;
}

/* Returns true if the boundary condition b is a load or support whose function of time has the rise time `rise` [s]
 * (rise_time). */
static bool rises_in(const struct boundary *b, real rise)
{
    return b->kind != BOUNDARY_MIRROR && rise_time(&b->time) == rise;
}

/* Writes to `out` one remark for all loads and supports of scene s that have the rise time of boundary condition number
 * b, if waves travel less than WAVE spacings in this time. tables: has the wave speed. Writes nothing if a boundary
 * condition with a number below b has the same rise time, since its remark covers both. */
static void advise_rise(const struct scene *s, const struct material_tables *tables, int b, FILE *out)
{
    const real rise = rise_time(&s->boundary[b].time), length = tables->wave_speed * rise / s->spacing;
    if (!rises_in(&s->boundary[b], rise) || length >= WAVE) return;
    for (int k = 0; k < b; k++)
        if (rises_in(&s->boundary[k], rise)) return;
    int more = 0;
    fprintf(out, "accuracy       boundary %s", s->boundary[b].name);
    for (int k = b + 1; k < s->boundaries; k++)
        if (rises_in(&s->boundary[k], rise)) fprintf(out, ", %s", s->boundary[k].name), more++;
    fprintf(out,
            " change%s within the time in which a wave travels %.3g spacings; waves shorter than %d spacings disperse: "
            "use a spacing of %s or a slower load\n",
            more ? "" : "s", length, WAVE, length_text_with_unit(s->spacing * length / WAVE, 2, s->spacing).text);
}

/* Writes a remark to `out` for each load of scene s (the input file), if it is dynamic, that rises too fast, because
 * waves travel less than WAVE spacings in its rise time, and for each initial pulse that is narrower than WAVE
 * spacings. tables: wave speed. */
static void advise_waves(const struct scene *s, const struct material_tables *tables, FILE *out)
{
    for (int b = 0; b < s->boundaries && scene_is_dynamic(s); b++) advise_rise(s, tables, b, out);
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_pulse && s->initial[k].pulse.width < WAVE * s->spacing)
            fprintf(out,
                    "accuracy       an initial pulse is %.3g spacings wide; below %d spacings it disperses; use a "
                    "spacing of %s\n",
                    s->initial[k].pulse.width / s->spacing, WAVE,
                    length_text_with_unit(s->initial[k].pulse.width / WAVE, 2, s->spacing).text);
}

/* Writes a remark to `out` if bodies of scene s (the input file) collide so fast that oscillations of the stress behind
 * the wave front can break their bonds or make them yield. */
static void advise_shocks(const struct scene *s, FILE *out)
{
    const struct shock shock = scene_find_collision_closest_to_damage(s);
    if (shock.share > 0)
        fprintf(out,
                "accuracy       bodies collide at %.3g m/s, %.3g times the speed at which the stress of the wave front "
                "reaches the strength or yield stress of a body. Behind the front stress oscillates by 10 to 30 %%, so "
                "%s too early: %s\n",
                shock.speed, shock.share, s->method == METHOD_MPM ? "points may yield" : "bonds may break",
                shock.remedy);
}

/* Writes a remark to `out` if the coarsest cells of the run are larger than the largest cells with which the loads and
 * the thin parts of the body are resolved. Only for input files that prescribe the number of levels of coarse cells
 * (the edge doubles with each level). */
static void advise_levels(const struct run *run, FILE *out)
{
    const struct levels_choice c =
        mesh_levels_choose_level_count(run->frame, &run->part, run->scene, run->clock.dt_critical);
    char text[1024];
    if (mesh_levels_given_by_scene_are_too_many(&c, run->frame, run->scene, text, sizeof text))
        fprintf(out, "accuracy       %s\n", text);
}

/* Writes a remark to `out` if a formula of a load or support of the run has no finite value at one of PULL_MOMENTS + 1
 * times of the run. */
static void advise_formulas(const struct run *run, FILE *out)
{
    for (int m = 0; m <= PULL_MOMENTS; m++) {
        if (loads_check_formula_values_are_finite(&run->loads, &run->part, run->scene->duration * m / PULL_MOMENTS) ==
            OK)
            continue;
        fprintf(out, "accuracy       %s; the run will stop at that time\n", status_message());
        return;
    }
}

/* Extends the range *least..*most [m] so that it contains the displacements along axis d that the support l prescribes
 * at time t [s] for its particles, evaluated at up to PULL_PLACES of them. p: all particles. Leaves the range unchanged
 * if l is another load, a support that leaves axis d free or that rotates, or if the displacement is not known. */
static void pulled_span(const struct load *l, const struct particles *p, int d, real t, real *least, real *most)
{
    if (l->boundary->kind != BOUNDARY_VELOCITY || !(l->boundary->components & 1 << d) || l->boundary->rotates) return;
    if (boundary_check_velocity_has_closed_form_integral(l->boundary) != OK) return;
    for (int64_t k = 0; k < l->n; k += 1 + l->n / PULL_PLACES) {
        real u[DIM_MAX];
        load_prescribed_displacement_of_particle(l, p, k, t, u);
        *least = real_min(*least, u[d]), *most = real_max(*most, u[d]);
    }
}

/* Returns the largest length of the particles p along axis d that the supports in l prescribe during the run, divided
 * by the initial length [1]; 1 if no support stretches the body. duration: duration of the run [s]. */
static real pulled_stretch(const struct loads *l, const struct particles *p, real duration, int d)
{
    real low, high, stretch = 1;
    particles_coordinate_range(p, p->n, d, &low, &high);
    for (int m = 1; m <= PULL_MOMENTS; m++) {
        real least = 0, most = 0;
        for (int b = 0; b < l->n; b++) pulled_span(&l->load[b], p, d, duration * m / PULL_MOMENTS, &least, &most);
        stretch = real_max(stretch, 1 + (most - least) / (high - low));
    }
    return stretch;
}

/* Stretch of metal bars above which they separate next to the points that a support drives [1], if shape functions are
 * evaluated at the present positions of points. Measured (inputs/choosing.md, Yielding). */
#define PARTS_AT_GRIP 1.3

/* Writes to `out` up to two remarks for bodies of metal, which the supports of scene s (the input file) pull to
 * `stretch` times their initial length. The first is written if the shape functions of s make forces too small at this
 * stretch. The second is written if, at this stretch, material points next to those with a prescribed velocity no
 * longer share grid nodes with them, so that the body separates there. */
static void advise_pulled_metal(const struct scene *s, real stretch, FILE *out)
{
    const struct weak_shape_function *weak = numerical_fracture_properties_of_shape_function(s->shape);
    if (weak && stretch > weak->stretch)
        fprintf(out,
                "accuracy       metal is pulled to %.3g times its length: with mpm.shape: %s it carries %s %% too "
                "little stress; set mpm.shape: cpgimp\n",
                stretch, weak->word, weak->too_little);
    if (stretch > PARTS_AT_GRIP)
        fprintf(out,
                "accuracy       metal is pulled to %.3g times its length: from about %.2g times on, the material "
                "points beside its supports separate, which is a numerical error and no fracture; pull it by wider "
                "parts that do not yield%s\n",
                stretch, PARTS_AT_GRIP, s->shape == SHAPE_CPGIMP ? "" : "; use mpm.shape: cpgimp");
}

/* Writes to `out` a remark if the supports among the loads l stretch the body of scene s so far that it separates
 * without fracture. An elastic body separates where neighbouring material points share no grid nodes, a metal body
 * earlier. Writes nothing unless the method is mpm and the scene has material points whose shape functions follow their
 * present positions, not their reference positions. p: particles on which l acts. */
static void advise_separation(const struct scene *s, const struct loads *l, const struct particles *p, FILE *out)
{
    bool yields = false;
    real stretch = 1;
    for (int m = 0; m < s->materials; m++) yields |= material_yields(&s->material[m]);
    for (int d = 0; d < s->dim && s->method == METHOD_MPM && p->n_free > 0; d++)
        stretch = real_max(stretch, pulled_stretch(l, p, s->duration, d));
    if (yields)
        advise_pulled_metal(s, stretch, out);
    else if (stretch > 1 && stretch > 0.9 * s->cell)
        fprintf(out,
                "accuracy       the body is stretched to %.3g times its length; beyond %.3g (cell over spacing) its "
                "points no longer share nodes and it breaks numerically; set mpm.cell: %.2g, mpm.shape: cpgimp or "
                "method: adaptive\n",
                stretch, s->cell, ceil(1.2 * stretch));
}

void print_accuracy_advice(const struct run *run, FILE *out)
{
    advise_features(run, out);
    advise_narrow_holes(run, out);
    print_advice_on_widths_of_narrow_parts(run, out);
    print_advice_on_close_crack_tips(run->scene, run->fracture, out);
    print_advice_on_incompressible_bodies(run, out);
    print_advice_on_stiffening_by_prescribed_motion(run, out);
    advise_faces(run->scene, out);
    print_stiffness_advice_on_particle_list_bodies(run, out);
    advise_waves(run->scene, &run->tables, out);
    advise_shocks(run->scene, out);
    print_advice_on_unbalanced_loads(run, out);
    print_load_step_accuracy_advice(run, out);
    advise_formulas(run, out);
    advise_levels(run, out);
    advise_separation(run->scene, &run->loads, &run->part, out);
    print_advice_on_gaps_to_mirror_planes(run, out);
}
