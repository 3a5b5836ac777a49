/* Bodies of metal: bars that hit a wall, and bodies under static loads beyond the elastic limit. */
#include <math.h>
#include <stdio.h>

#include "laws_bench.h"
#include "grid/grid_part.h"
#include "probes/diagnostics.h"
#include "step/step.h"

/* ---- bars that hit a wall ---------------------------------------------------------------------------------------- */

/* State of a bar after it has hit a wall: mean height of its uppermost layer and largest radius of its particles [m],
 * largest plastic strain [1] and temperature [K], root mean square of the pressure [Pa], error of the energy balance
 * [1]. */
struct bar_rest {
    double top, radius, strain, temperature, pressure, balance;
};

/* Gives each material point of the run its own dilatation in place of the mean over its grid cell, as in codes
 * without a treatment of volumetric locking. */
static void points_have_own_dilatations(struct run *run)
{
    for (int m = 0; m < run->scene->materials; m++) run->tables.elastic[m].mean_dilatation = false;
    run->grid->transfer.mean_dilatation = false;
}

/* Computes the shape and state of a bar that has hit a wall from its particles p: length, largest radius, plastic
 * strain and temperature, and root mean square of the pressure. Stores them in *r, whose largest values must be 0
 * before. spacing: of the particles [m]. */
static void bar_measure(struct bar_rest *r, const struct particles *p, double spacing)
{
    double length = 0, sum = 0, count = 0, squares = 0;
    for (int64_t i = 0; i < p->n; i++) {
        length = fmax(length, p->X[2][i]);
        squares += square((p->stress[0][i] + p->stress[1][i] + p->stress[2][i]) / 3);
        r->radius = fmax(r->radius, hypot(p->x[0][i], p->x[1][i]));
        r->strain = fmax(r->strain, p->plastic_strain[i]);
        if (p->temperature) r->temperature = fmax(r->temperature, p->temperature[i]);
    }
    for (int64_t i = 0; i < p->n; i++)
        if (p->X[2][i] > length - 0.5 * spacing) sum += p->x[2][i], count++;
    r->top = sum / count, r->pressure = sqrt(squares / (double)p->n);
}

/* Runs the scene file `path` of a bar that hits a wall, with the overrides o, and stores its state at the end in *r.
 * c->given[0]: 1 for linear shape functions, else gimp; c->given[1]: 1 if points have their own dilatation in place of
 * the mean of their cell. Returns FAILED if a step fails. */
static status bar_strike(struct bar_rest *r, const char *path, const struct laws_case *c, struct bench_overrides *o)
{
    struct run e;
    struct scene s;
    bench_overrides_append(o, "mpm.shape", c->given[0] == 1 ? "linear" : "gimp");
    bench_overrides_append(o, "output.frames", "0");
    TRY(bench_engine_make(&e, &s, path, NULL, bench_overrides_as_array(o), o->n));
    if (c->given[1] == 1) points_have_own_dilatations(&e);
    const status ran = run_advance_to_end_time(&e);
    *r = (struct bar_rest){.balance = e.diagnostics->now.balance_error};
    bar_measure(r, &e.part, s.spacing);
    bench_engine_free(&e, &s);
    return ran;
}

status laws_measure_wilkins_bar_impact(const struct laws_case *c, double *measured)
{
    struct bench_overrides o = {0};
    struct bar_rest r;
    TRY(bar_strike(&r, "inputs/taylor_bar.yaml", c, &o));
    measured[0] = 1e3 * r.top + 0.2 /* half a spacing */, measured[1] = 1e3 * r.radius, measured[2] = 100 * r.balance;
    return OK;
}

status laws_measure_copper_bar_impact(const struct laws_case *c, double *measured)
{
    struct bench_overrides o = {0};
    struct bar_rest r;
    bench_overrides_append(&o, "material",
                           "{young: 117 GPa, poisson: 0.35, density: 8930, yield_stress: 157 MPa, "
                           "hardening: {linear: {modulus: 425 MPa}}}");
    TRY(bar_strike(&r, "inputs/taylor_bar_jc.yaml", c, &o));
    measured[0] = 1e3 * r.top, measured[1] = 1e3 * r.radius, measured[2] = r.strain, measured[3] = 1e-9 * r.pressure;
    measured[4] = 100 * r.balance;
    return OK;
}

status laws_measure_johnson_cook_bar_impact(const struct laws_case *c, double *measured)
{
    struct bench_overrides o = {0};
    struct bar_rest r;
    bench_overrides_append(&o, "material.density", "8930");
    bench_overrides_append(&o, "material.taylor_quinney", "1");
    TRY(bar_strike(&r, "inputs/taylor_bar_jc.yaml", c, &o));
    measured[0] = 1e3 * r.top, measured[1] = 1e3 * r.radius, measured[2] = r.temperature, measured[3] = 100 * r.balance;
    return OK;
}

/* ---- a body whose volume hardly changes -------------------------------------------------------------------------- */

/* Cook's membrane in plane strain, and as a slab of two points across its depth that does not move along z. */
static const char *const cook[] = {
    "name: cook\nvariables: {h: 1 mm}\nspace: plane strain\nthickness: 5 mm\nduration: 1 s\nmethod: mpm\n"
    "material: {young: 70 MPa, poisson: 0.4999, density: 1000}\nparticles: {spacing: h}\n"
    "body: {polygon: {corners: [[0, 0], [48 mm, 44 mm], [48 mm, 60 mm], [0, 44 mm]]}}\nboundary:\n"
    "  - {name: wall, fixed: all, region: {box: {from: [-inf, -inf], to: [h, inf]}}}\n"
    "  - {name: end, traction: [0, 6.25 kPa], face: x+, region: {box: {from: [48 mm - h, -inf], to: [inf, inf]}}}\n",
    "name: cook\nvariables: {h: 1 mm}\nspace: solid\nduration: 1 s\nmethod: mpm\n"
    "material: {young: 70 MPa, poisson: 0.4999, density: 1000}\nparticles: {spacing: h}\n"
    "body: {extrude: {shape: {polygon: {corners: [[0, 0], [48 mm, 44 mm], [48 mm, 60 mm], [0, 44 mm]]}}, from: 0, "
    "to: 2*h}}\nboundary:\n"
    "  - {name: wall, fixed: all, region: {box: {from: [-inf, -inf, -inf], to: [h, inf, inf]}}}\n"
    "  - {name: end, traction: [0, 6.25 kPa, 0], face: x+, region: {box: {from: [48 mm - h, -inf, -inf], to: [inf, "
    "inf, "
    "inf]}}}\n"
    "  - {name: sides, fixed: [z], region: {box: {from: [-inf, -inf, -inf], to: [inf, inf, inf]}}}\n"};

status laws_measure_cook_membrane(const struct laws_case *c, double *measured)
{
    struct run e;
    struct scene s;
    struct bench_overrides o = {0};
    const bool solid = c->given[0] == 1, current = c->given[1] == 1;
    const real corner[DIM_MAX] = {48e-3, 60e-3, 0};
    bench_overrides_append(&o, "variables.h", "%g mm", c->given[2]);
    bench_overrides_append(&o, "mpm.frame", current ? "current" : "reference");
    bench_overrides_append(&o, "solver", current ? "relaxation" : "static");
    if (!current) bench_overrides_append(&o, "steps.number", "1");
    if (current) bench_overrides_append(&o, "solver_steps", "1000000");
    if (current) bench_overrides_append(&o, "solver_tolerance", "1e-3");
    bench_overrides_append(&o, "output.frames", "0");
    TRY(bench_engine_make(&e, &s, "cook", cook[solid], bench_overrides_as_array(&o), o.n));
    const status ran = run_advance_to_end_time(&e);
    const int64_t i = particles_index_nearest_to_position(&e.part, corner);
    const struct load *end = &e.loads.load[1];
    double area = 0; /* the steps of the lattice make the loaded face longer than 16 mm */
    for (int64_t k = 0; k < end->n; k++) area += end->share[1][k];
    const double depth = solid ? 2 * s.spacing : 5e-3;
    measured[0] = 1e6 * (e.part.x[1][i] - e.part.X[1][i]) * 16e-3 * depth / area;
    bench_engine_free(&e, &s);
    return ran;
}

/* ---- bodies under static loads ----------------------------------------------------------------------------------- */

#define YIELD 250e6 /* [Pa] */
#define YOUNG 200e9 /* [Pa] */
#define POISSON 0.3

/* Runs a body of ideally plastic steel in the reference frame in load steps to the full load, and updates the stresses
 * of its particles. text: scene keys besides method, material and output; run, s: receive the run and its scene.
 * Returns FAILED or REFUSED if the run does; release `run` and s with bench_engine_free after OK only. */
static status body_run(struct run *run, struct scene *s, const char *text)
{
    char whole[2048];
    snprintf(whole, sizeof whole,
             "name: body\nduration: 1 s\nmethod: mpm\nsolver: static\noutput: {frames: 0}\n"
             "material: {young: %g, poisson: %g, density: 7850, yield_stress: %g}\n%s",
             YOUNG, POISSON, YIELD, text);
    TRY(bench_engine_make(run, s, "body", whole, NULL, 0));
    const status ran = run_advance_to_end_time(run);
    if (ran != OK) return bench_engine_free(run, s), ran;
    run_update_particle_motion_and_stress(run);
    return OK;
}

status laws_measure_torsion_moment(const struct laws_case *c, double *measured)
{
    struct run e;
    struct scene s;
    char text[1024];
    const double R = 10e-3, length = 2e-3, shear = YOUNG / (2 * (1 + POISSON));
    const double twist = c->given[0] * YIELD / sqrt(3) / shear / R; /* angle per length [1/m] */
    snprintf(
        text, sizeof text,
        "space: solid\nsteps: {number: 8}\nbody: {cylinder: {from: [0, 0, 0], to: [0, 0, %g], radius: %g}}\n"
        "particles: {spacing: 0.5 mm}\nboundary:\n"
        "  - {name: twist, displacement: [\"-y*%.12g\", \"x*%.12g\", free], face: z+, time: {ramp: {until: 1 s}}}\n"
        "  - {name: hold, displacement: [0, 0, 0], face: z-}\n",
        length, R, twist * length, twist * length);
    TRY(body_run(&e, &s, text));
    const struct particles *p = &e.part;
    double moment = 0;
    for (int64_t i = 0; i < p->n; i++)
        moment += p->volume[i] * (p->X[0][i] * p->stress[4][i] - p->X[1][i] * p->stress[5][i]);
    measured[0] = moment / length;
    bench_engine_free(&e, &s);
    return OK;
}

status laws_measure_beam_bending(const struct laws_case *c, double *measured)
{
    struct run e;
    struct scene s;
    char text[1024];
    const bool strain = c->given[0] == 1;
    const double half = 8e-3, length = 40e-3, nu = POISSON;
    /* First yield of the edges: in plane strain sigma_zz = nu sigma_xx. */
    const double first = strain ? YIELD / sqrt(1 - nu + nu * nu) : YIELD;
    const double curvature = c->given[1] * first * (strain ? 1 - nu * nu : 1) / YOUNG / half;
    snprintf(text, sizeof text,
             "space: plane %s\nthickness: 1 mm\nsteps: {number: 20}\nparticles: {spacing: 0.5 mm}\n"
             "body: {box: {from: [0, %g], to: [%g, %g]}}\nboundary:\n"
             "  - {name: bend, displacement: [\"-%.12g*y\", free], face: x+, time: {ramp: {until: 1 s}}}\n"
             "  - {name: left, mirror: {axis: x, at: 0}}\n"
             "  - {name: pin, fixed: [y], region: {box: {from: [0, -0.4 mm], to: [0.5 mm, 0.4 mm]}}}\n",
             strain ? "strain" : "stress", -half, length, half, curvature * length);
    TRY(body_run(&e, &s, text));
    const struct particles *p = &e.part;
    double moment = 0;
    for (int64_t i = 0; i < p->n; i++) moment -= p->volume[i] * p->X[1][i] * p->stress[0][i];
    measured[0] = moment / length / (first * 1e-3 * 2 * half * half / 3);
    bench_engine_free(&e, &s);
    return OK;
}

/* A hollow sphere or, in plane strain, a hollow cylinder, of inner radius 1, whose plastic zone ends at the radius c.
 * With the dimension D of the space and Y = sigma_y in the sphere, 2 sigma_y/3^0.5 in the cylinder:
 *     beyond c (Lame): sigma_t - sigma_r = Y (c/r)^D
 *     within c:        a = k ((c/r)^D - 1),   k = 2 (1 - nu) sigma_y/E (sphere), 4/3 (1 - nu^2) sigma_y/E (cylinder)
 * as flow keeps the volume, and the volume is elastic (Hill 1950, chapter 5). Exact for the sphere; for the cylinder
 * with sigma_z = (sigma_r + sigma_t)/2 in the plastic zone, exact at nu = 1/2. Both relations give c as a mean over
 * many particles. The number of particles that have yielded does not: near c some points of each cell have and others
 * have not, and those in steps of the inner face never do, so that c is too small by up to a cell. */
struct shell_state {
    double elastic, plastic; /* c over the inner radius from the stress beyond it, and from the plastic strain [1] */
    double outer;            /* mean displacement of the outer layer [m] */
};

/* Returns the radius c of the plastic front, between 1 and 2, at which the integral of the plastic strain k ((c/r)^D -
 * 1) times r^(D - 1) over r from 1 to c equals `sum`, by bisection. k: constant of the plastic strain [1]; D:
 * dimension, 3 for a sphere, 2 for a cylinder. */
static double plastic_front(double sum, double k, int D)
{
    double low = 1, high = 2;
    for (int times = 0; times < 50; times++) {
        const double c = 0.5 * (low + high), power = pow(c, D);
        if (k * (power * log(c) - (power - 1) / D) > sum)
            high = c;
        else
            low = c;
    }
    return low;
}

/* Computes the state *r of a hollow sphere (p->dim 3) or cylinder (p->dim 2) of radii a and 2 a [m] from its particles.
 * guess: estimated radius of the plastic front over a [1]; the stress is evaluated in the outer half of the elastic
 * part. spacing: of the particles [m]; depth: length of the cylinder [m]. */
static void shell_measure(struct shell_state *r, const struct particles *p, double a, double guess, double spacing,
                          double depth)
{
    const int D = p->dim;
    const double Y = D == 3 ? YIELD : 2 / sqrt(3) * YIELD, full = D == 3 ? M_PI / 2 : M_PI / 2 * depth;
    const double k = D == 3 ? 2 * (1 - POISSON) * YIELD / YOUNG : 4.0 / 3 * (1 - POISSON * POISSON) * YIELD / YOUNG;
    double elastic = 0, elastic_count = 0, strains = 0, moved = 0, count = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const double z = D == 3 ? p->X[2][i] : 0, w = D == 3 ? p->x[2][i] : 0;
        const double x = p->X[0][i], y = p->X[1][i], R = sqrt(x * x + y * y + z * z);
        const double now = sqrt(square(p->x[0][i]) + square(p->x[1][i]) + w * w);
        const real *const *s = (const real *const *)p->stress;
        double radial = x * x * s[0][i] + y * y * s[1][i] + 2 * x * y * s[D == 3 ? 3 : 2][i];
        if (D == 3) radial += z * z * s[2][i] + 2 * y * z * s[4][i] + 2 * z * x * s[5][i];
        const double trace = s[0][i] + s[1][i] + (D == 3 ? s[2][i] : 0);
        const double difference = (trace - D * radial / (R * R)) / (D - 1);
        if (R > 0.5 * (guess + 2) * a) elastic += R / a * pow(difference / Y, 1.0 / D), elastic_count++;
        strains += p->volume[i] * p->plastic_strain[i];
        if (R > 2 * a - spacing) moved += now - R, count++;
    }
    r->elastic = elastic / elastic_count, r->outer = moved / count;
    r->plastic = plastic_front(strains / (full * pow(a, D)), k, D);
}

/* Runs a hollow sphere of radii 10 and 20 mm (an octant) or, if `sphere` is false, a hollow cylinder (a quarter, in
 * plane strain) under the inner pressure `pressure` [Pa], and stores its state in *r. spacing: of the particles [m];
 * guess: estimated radius of the plastic front over the inner radius [1]. Returns FAILED if a load step fails. */
static status shell_run(bool sphere, double spacing, double pressure, double guess, struct shell_state *r)
{
    struct run e;
    struct scene s;
    char text[1024];
    const double a = 10e-3, b = 20e-3;
    const char *const ends = sphere ? "0, 0, 0" : "0, 0", *const far = sphere ? "1, 1, 1" : "1, 1";
    snprintf(text, sizeof text,
             "space: %s\nsteps: {number: 12}\nparticles: {spacing: %g}\nbody:\n  - {%s: {centre: [%s], radius: %g}}\n"
             "  - {subtract: {%s: {centre: [%s], radius: %g}}}\n  - {intersect: {box: {from: [%s], to: [%s]}}}\n"
             "boundary:\n  - {name: inner, pressure: %.12g, region: {%s: {centre: [%s], radius: %g}}, "
             "time: {ramp: {until: 1 s}}}\n  - {name: left, mirror: {axis: x, at: 0}}\n"
             "  - {name: below, mirror: {axis: y, at: 0}}\n%s",
             sphere ? "solid" : "plane strain\nthickness: 1 mm", spacing, sphere ? "ball" : "disc", ends, b,
             sphere ? "ball" : "disc", ends, a, ends, far, pressure, sphere ? "ball" : "disc", ends, 1.5 * a,
             sphere ? "  - {name: back, mirror: {axis: z, at: 0}}\n" : "");
    TRY(body_run(&e, &s, text));
    shell_measure(r, &e.part, a, guess, spacing, 1e-3);
    bench_engine_free(&e, &s);
    return OK;
}

status laws_measure_hollow_sphere(const struct laws_case *c, double *measured)
{
    (void)c;
    const double full = YIELD * (1 - POISSON) * 20e-3 / YOUNG; /* outer displacement when the front reaches it [m] */
    struct shell_state r;
    double low = 1.34, high = 1.46;
    TRY(shell_run(true, 0.5e-3, 1.19635 * YIELD, 1.5, &r));
    measured[0] = r.elastic, measured[1] = r.plastic, measured[2] = 1e6 * r.outer;
    while (high - low > 0.01) {
        const double middle = 0.5 * (low + high);
        const status ran = shell_run(true, 0.5e-3, middle * YIELD, 1.5, &r);
        if (ran == REFUSED) return ran;
        if (ran == FAILED || r.outer > 2 * full) /* a load step without equilibrium: the sphere bears less */
            high = middle;
        else
            low = middle;
    }
    measured[3] = 0.5 * (low + high);
    return OK;
}

status laws_measure_thick_cylinder(const struct laws_case *c, double *measured)
{
    const double s = 2 / sqrt(3), front = c->given[0];
    struct shell_state r;
    TRY(shell_run(false, 0.25e-3, (0.5 * s * (1 - front * front / 4) + s * log(front)) * YIELD, front, &r));
    measured[0] = r.elastic, measured[1] = r.plastic;
    return OK;
}
