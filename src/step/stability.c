/* Checks stability during a run: stops a run that has diverged, and names a remedy, such as another time step, load or
 * method. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/mpm/stress.h"
#include "mesh/mesh_part.h"
#include "step/stability.h"
#include "probes/diagnostics.h"
#include "contact/contact_part.h"
#include "step/report.h"
#include "run/say.h"
#include "rigid/rigid_part.h"
#include "step/checks.h"

#define LOAD_SHARE_LEAST 0.5 /* least share of the motion that a load must explain: speeds double at free faces */
#define LARGE_STRAIN 0.1     /* initial strain that counts as the cause: stresses of a tenth of the modulus */
#define ENERGY_STEPS 50      /* steps before the energy check begins */
/* Smallest ratio of the energy gained without a source to the largest energy at which a run fails [1]. Empirical: the
 * first steps after a jump in velocity show 0.1, unstable runs that break all bonds 0.9. */
#define ENERGY_FROM_NOWHERE 0.5
/* Smallest ratio of the energy that breaking bonds release beyond what they had stored to the largest energy at which a
 * run fails [1]. Empirical: scenes in inputs/ show none with any model; ospd under pressure shows 0.4. */
#define RELEASED_FROM_NOWHERE 0.25
/* Ratio of kinetic energy 1/2 m v- . v+ to strain energy below which velocities change sign in every step [1]; v-, v+:
 * velocities before and after a velocity update. Time steps below the critical step have at least
 * -(dt/dt_critical)^2. */
#define KINETIC_LEAST -0.9
enum { INVERSION_STEPS = 50 }; /* steps between checks for inverted cells, which cost about half a step */
enum { MOMENTS = 256 };        /* number of times at which a function of time is evaluated */

/* ---- speeds ------------------------------------------------------------------------------------------------------ */

/* Returns the largest present speed of peridynamic particles and of material points on the grid [m/s]. For nodes of
 * the reference frame (mesh of the undeformed body), the largest magnitude of a velocity component is used instead of
 * the speed. p: all particles. */
static real fastest_now(const struct particles *p, const struct lagrangian_mesh *reference)
{
    const real moving = real_max(particles_largest_speed_of_list(p, p->list[KIND_PD], p->n_of[KIND_PD]),
                                 particles_largest_speed_of_list(p, p->list_free, p->n_free));
    return reference->mesh.points > 0 ? real_max(moving, reference->speed) : moving;
}

void stability_store_largest_initial_speed(struct stability *s, const struct particles *p)
{
    s->start_speed = particles_largest_speed_of_all(p);
    quantity_samples_add_value(&s->speed, 0, square(s->start_speed));
}

/* ---- loads ------------------------------------------------------------------------------------------------------- */

/* Computes the largest value *most and the mean value *mean of |f| between the times `from` and `to` [s], from MOMENTS
 * evenly spaced times. f: function of time of a load. */
static void factors(const struct time_function *f, real from, real to, real *most, real *mean)
{
    *most = *mean = 0;
    for (int k = 0; k < MOMENTS; k++) {
        const real factor = fabs(time_function_value(f, from + (k + 0.5) / MOMENTS * (to - from)));
        *most = real_max(*most, factor);
        *mean += factor / MOMENTS;
    }
}

/* Returns the speed to which `load` alone accelerates the fastest of its particles within the last `steps` time steps
 * [m/s]. For a prescribed motion returns the largest prescribed speed, for mirrors and absorbing boundaries 0. clock:
 * present time and time step. p: all particles. */
static real load_speed(const struct run_clock *clock, const struct particles *p, const struct load *load, real steps)
{
    const struct boundary *b = load->boundary;
    const bool drives = b->kind == BOUNDARY_VELOCITY;
    const real from = drives ? 0 : real_max(0, clock->t - steps * clock->dt);
    real most, mean, fast2 = 0;
    if (b->kind == BOUNDARY_MIRROR || b->kind == BOUNDARY_ABSORBING) return 0;
    factors(&b->time, from, clock->t, &most, &mean);
    if (b->displaces) return load_largest_speed_of_prescribed_displacement(load, p, clock->t + clock->dt);
    if (drives) return most * sqrt(dot(b->value, b->value, p->dim));
    for (int64_t k = 0; k < load->n; k++) {
        real a2 = 0;
        for (int d = 0; d < p->dim; d++) a2 += square(load->share[d][k] * b->value[d] / p->mass[load->particle[k]]);
        fast2 = real_max(fast2, a2);
    }
    return mean * (clock->t - from) * sqrt(fast2);
}

/* Returns true if the loads explain the motion of the particles p in a run that has diverged, so that no instability
 * has to be assumed: if `given`, the energy at the start plus the work of the loads [J], is at least LOAD_SHARE_LEAST
 * times the kinetic energy, or if this is not finite. frame: mesh whose nodes move, too. */
static bool loads_explain_motion(const struct particles *p, const struct lagrangian_mesh *frame, real given)
{
    const real kinetic = particles_kinetic_energy(p) + lagrangian_mesh_kinetic_energy(frame);
    return !isfinite(kinetic) || given >= LOAD_SHARE_LEAST * kinetic;
}

/* Returns the largest absolute component of the displacement gradients that the initial states of scene s prescribe
 * [1]. */
static real start_strain(const struct scene *s)
{
    real most = 0;
    for (const struct scene_initial *k = s->initial; k < s->initial + s->initials; k++)
        for (int a = 0; a < s->dim * s->dim && k->sets_strain; a++)
            most = real_max(most, fabs(k->displacement_gradient[a]));
    return most;
}

/* Writes to text[capacity] which load or initial state explains the motion of the diverged run. steps: number of
 * steps in which the squared speed last grew tenfold; INFINITY: unknown. Returns false, without text, if none explains
 * it. */
static bool load_explanation(const struct run *run, real steps, char *text, size_t capacity)
{
    static const char *const unit[] = {"m/s", "Pa", "N/m^3", "", "", "Pa"};
    static const char *const word[] = {"velocity", "traction", "body force", "", "", "pressure"};
    const real window =
        real_min((real)run->clock.step, isfinite(steps) ? real_max(ceil(steps), RISE_STRIDE) : (real)run->clock.step);
    const struct load *worst = NULL;
    real speed = LOAD_SHARE_LEAST * run->tables.wave_speed;
    const real work = run->loads.work + run->loads.constraint_work;
    const real given = run->diagnostics->energy_start + run->loads.work + run->loads.constraint_work;
    if (!loads_explain_motion(&run->part, run->frame, given)) return false;
    if (run->stability->start_speed >= speed) {
        snprintf(text, capacity,
                 "a smaller time step does not help: the scene starts with %.3g m/s, %.3g times the wave speed: check "
                 "the velocities of its bodies and of `initial`, and their units",
                 run->stability->start_speed, run->stability->start_speed / run->tables.wave_speed);
        return true;
    }
    if (start_strain(run->scene) >= LARGE_STRAIN) {
        snprintf(
            text, capacity,
            "a smaller time step does not help: the scene starts with a strain of %.3g, whose energy throws the body "
            "apart: check the displacement gradients of `initial` (0.001 is a strain of 0.1 %%)",
            start_strain(run->scene));
        return true;
    }
    for (int b = 0; b < run->loads.n; b++) {
        const real one = load_speed(&run->clock, &run->part, &run->loads.load[b], window);
        if (one >= speed) speed = one, worst = &run->loads.load[b];
    }
    if (!worst) return false;
    const struct boundary *b = worst->boundary;
    const real size = sqrt(dot(b->value, b->value, run->part.dim));
    const real value = b->kind == BOUNDARY_PRESSURE ? fabs(b->value[0]) : size;
    char within[40] = "";
    if (b->kind != BOUNDARY_VELOCITY) snprintf(within, sizeof within, " in %.0f step%s", window, window > 1 ? "s" : "");
    snprintf(text, capacity,
             "a smaller time step does not help: boundary %s, a %s of %.3g %s, %s %.3g m/s%s, %.3g times the wave "
             "speed, and loads have done %.3g J of work; check the value of this boundary and its unit",
             b->name, b->displaces ? "displacement" : word[b->kind], value,
             b->displaces ? "m"
             : b->by_mass ? "N/kg"
                          : unit[b->kind],
             b->kind == BOUNDARY_VELOCITY ? "drives its particles at" : "gives its particles a speed of", speed, within,
             speed / run->tables.wave_speed, work);
    return true;
}

/* ---- remedy ------------------------------------------------------------------------------------------------------ */

/* Writes the advice to choose a smaller time step to text[capacity]. Returns the length of this text. s: scene, for the
 * key to change; clock: present time step and critical one. */
static int say_step(const struct scene *s, const struct run_clock *clock, char *text, size_t capacity)
{
    return snprintf(text, capacity, "choose a smaller time.%s (now dt = %.3g s, %.2f of the critical %.3g s)",
                    s->time_step > 0 ? "step" : "safety", clock->dt, clock->dt / clock->dt_critical,
                    clock->dt_critical);
}

/* Returns true if a mirror (plane of symmetry) of the scene s also prevents motion along its plane
 * (hold_tangential). */
static bool holds_images(const struct scene *s)
{
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR && s->boundary[b].hold_tangential) return true;
    return false;
}

/* Writes alternatives for a scene s that gains energy to text[capacity]: for each option that the scene can do without,
 * another choice such as `method: pd`. reference: mesh of the run; coupling: coupling method. */
static void say_others(const struct scene *s, const struct lagrangian_mesh *reference, enum coupling coupling,
                       char *text, size_t capacity)
{
    const char *other[8];
    int n = 0;
    if (s->method == METHOD_ADAPTIVE) other[n++] = "method: pd";
    if (s->method != METHOD_PD && reference->mesh.points > 0)
        other[n++] = "mpm.frame: current";
    else if (!scene_reason_not_to_advise_total_lagrangian_mpm(s))
        other[n++] = "mpm.frame: reference";
    if (coupling != COUPLING_PARTIAL_STRESS && s->method == METHOD_ADAPTIVE) other[n++] = "coupling: partial stress";
    if (s->method != METHOD_PD && reference->mesh.points == 0 && s->transfer == TRANSFER_FLIP)
        other[n++] = "mpm.transfer: apic";
    if (s->model != MODEL_BOND && s->method != METHOD_MPM) other[n++] = "model: bond";
    if (holds_images(s)) other[n++] = "`fixed` in place of a mirror with tangential: held";
    if (n == 0) other[n++] = "method: adaptive";
    for (int k = 0, used = 0; k < n && used < (int)capacity; k++)
        used += snprintf(text + used, capacity - (size_t)used, "%s%s",
                         k == 0       ? ""
                         : k == n - 1 ? " or "
                                      : ", ",
                         other[k]);
}

#define SQUEEZED 0.4 /* ratio of a bond's length to its reference length below which the bond laws are not valid */

/* Returns the smallest ratio of present to reference length of an intact bond of b between particles of p, at most 1
 * [1]. */
static real shortest_bond(const struct bonds *b, const struct particles *p)
{
    real least2 = 1;
    for (int64_t row = 0; row < b->rows; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            real length2 = 0;
            for (int d = 0; d < p->dim; d++) length2 += square(p->x[d][it.bond.nbr] - p->x[d][b->particle[row]]);
            if (it.bond.w != 0) least2 = real_min(least2, length2 * square(it.bond.inverse_length));
        }
    return sqrt(least2);
}

/* Writes to text[capacity] how far the bonds b of the particles p are compressed, with a remedy, for the message of a
 * diverged run. Returns false, without text, if no bond is shorter than SQUEEZED times its reference length. clock: for
 * the time step. */
static bool squeeze_explanation(const struct bonds *b, const struct particles *p, const struct run_clock *clock,
                                char *text, size_t capacity)
{
    const real least = shortest_bond(b, p);
    if (!(least < SQUEEZED)) return false;
    snprintf(text, capacity,
             "bonds are compressed to %.2g of their length, beyond the validity of the bond laws: check that so much "
             "compression is intended, or use a smaller time.safety (now %.2f of the critical %.3g s), which keeps "
             "particles farther apart",
             least, clock->dt / clock->dt_critical, clock->dt_critical);
    return true;
}

void run_describe_remedy_for_divergence(const struct run *run, const struct quantity_samples *earlier_samples,
                                        real growing_value, char *text, size_t capacity)
{
    real steps;
    char others[256];
    const enum growth_rate rate =
        quantity_samples_classify_growth_rate(earlier_samples, run->clock.step, growing_value, &steps);
    if (scene_has_load_steps(run->scene)) { /* load steps have no time step */
        snprintf(text, capacity,
                 "this occurred in a static equilibrium; use more load steps (steps.number) or a smaller "
                 "solver_tolerance, and please report the scene");
        return;
    }
    if (load_explanation(run, steps, text, capacity)) return;
    const bool long_step = run->clock.dt > run->clock.dt_critical;
    if (!long_step && squeeze_explanation(&run->bonds, &run->part, &run->clock, text, capacity)) return;
    if (rate == RISE_FAST || long_step || !scene_is_dynamic(run->scene)) {
        say_step(run->scene, &run->clock, text, capacity);
        return;
    }
    say_others(run->scene, run->frame, run->coupling_kind, others, sizeof others);
    if (rate == RISE_UNSURE) {
        const int used = say_step(run->scene, &run->clock, text, capacity);
        snprintf(text + used, capacity - (size_t)used,
                 "; if the run stays unstable, a method of this scene gains energy: try %s", others);
        return;
    }
    if (run->diagnostics->now.balance_error < 0 && run->diagnostics->now.energy.fracture >= 0) {
        snprintf(text, capacity,
                 "a smaller time step (now %.2f of the critical %.3g s) may not help, because the energy balance shows "
                 "no gain: loads or supports may cause the motion: check them, or try %s",
                 run->clock.dt / run->clock.dt_critical, run->clock.dt_critical, others);
        return;
    }
    snprintf(text, capacity,
             "the energy error took %s%.0f steps to grow tenfold; with an unstable time step it takes fewer than %d, "
             "so a smaller time step (now %.2f of the critical %.3g s) may not help; one of the methods in this scene "
             "gains energy: try %s, and please report the scene",
             isfinite(steps) ? "" : "more than ", isfinite(steps) ? steps : (real)RISE_STEPS, RISE_STEPS,
             run->clock.dt / run->clock.dt_critical, run->clock.dt_critical, others);
}

/* ---- divergence and inversion ------------------------------------------------------------------------------------ */

/* Returns FAILED, with a message and a remedy, if a particle of the run is faster than the fastest wave, or has a
 * position or velocity that is not finite. Material points on the grid are always checked. check_peridynamic: true to
 * check the peridynamic particles too; check_mesh_points: true to check the material points of a mesh too. run: the
 * run.
 */
status run_check_particles_for_divergence(const struct run *run, bool check_peridynamic, bool check_mesh_points)
{
    char remedy[REMEDY_LENGTH];
    const status s = diagnostics_check_particles_for_divergence(&run->part, check_peridynamic, check_mesh_points,
                                                                run->tables.wave_speed, run->clock.step, run->clock.t);
    if (s == OK) return OK;
    const real speed = fastest_now(&run->part, run->frame), limit = run->tables.wave_speed;
    run_describe_remedy_for_divergence(run, &run->stability->speed,
                                       square(isfinite(speed) && speed > limit ? speed : limit), remedy, sizeof remedy);
    return status_set(s, "%s; %s", status_message(), remedy);
}

/* Returns FAILED, with a message, if a cell of the mesh of `reference` with points of p is inverted. Tests only every
 * INVERSION_STEPS steps (of `clock`) and at the end. An inverted cell resists deformation like an intact one, so that
 * neither energy nor speed reveals it. */
static status inversion_check(const struct run_clock *clock, const struct particles *p,
                              const struct lagrangian_mesh *reference)
{
    if (reference->mesh.points == 0 || (clock->step % INVERSION_STEPS != 0 && clock->step < clock->steps)) return OK;
    char what[48] = "a coarse cell";
    real X[DIM_MAX] = {0};
    const int64_t i = mesh_first_particle_in_inverted_cell(&reference->mesh, p);
    if (i == p->n && !mesh_levels_find_inverted_coarse_cell(&reference->levels, X)) return OK;
    if (i < p->n) {
        particle_reference_position(p, i, X);
        snprintf(what, sizeof what, "particle %d", (int)p->id[i]);
    }
    return status_set(
        FAILED,
        "inverted at step %lld, t = %.3g s: a cell of the mesh of material points (mpm.frame: reference) is "
        "turned inside out at %s, at the start at (%.6g, %.6g, %.6g) m; use mpm.frame: current, or loads "
        "and supports that compress or shear the body less there",
        (long long)clock->step, clock->t, what, X[0], X[1], X[2]);
}

/* Returns FAILED, with a message, if the formula of a load of l has a value that is not finite at a particle of p. Such
 * a value makes the impulse of the loads infinite or NaN; only then the formulas are evaluated, at the times of the
 * last steps of `clock`. At the end of the run they are always evaluated once. */
static status formula_check(const struct loads *l, const struct particles *p, const struct run_clock *clock)
{
    const real *impulse = l->impulse;
    if (!isfinite(impulse[0] + impulse[1] + impulse[2]))
        for (int half = -3; half <= 2; half++)
            TRY(loads_check_formula_values_are_finite(l, p, real_max(0, clock->t + 0.5 * half * clock->dt)));
    return clock->step == clock->steps ? loads_check_formula_values_are_finite(l, p, clock->t) : OK;
}

status run_check_stability_after_step(struct run *run)
{
    const bool diverged =
        run->frame->mesh.points > 0 && !(run->frame->speed <= run->tables.wave_speed / sqrt(run->part.dim));
    TRY(formula_check(&run->loads, &run->part, &run->clock));
    if (diverged) lagrangian_mesh_update_point_motion(run->frame, &run->part, &run->loads);
    TRY(run_check_particles_for_divergence(run, run->stability->diverged || run->part.n_grid_coupled > 0, diverged));
    TRY(inversion_check(&run->clock, &run->part, run->frame));
    TRY(contact_warn_or_fail_if_overlap_too_large(run));
    TRY(rigids_check_motion_per_step_is_small(run->rigid, run->scene, &run->clock));
    if (run->clock.step % RISE_STRIDE == 0)
        quantity_samples_add_value(&run->stability->speed, run->clock.step,
                                   square(fastest_now(&run->part, run->frame)));
    return OK;
}

/* ---- energy ------------------------------------------------------------------------------------------------------ */

/* Returns the index of the particle with the largest speed. p: all particles. */
static int64_t fastest_particle(const struct particles *p)
{
    int64_t fastest = 0;
    real most = -1;
    for (int64_t i = 0; i < p->n; i++) {
        real speed2 = 0;
        for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][i]);
        if (speed2 > most) most = speed2, fastest = i;
    }
    return fastest;
}

/* Returns true if the bodies have gained more energy than a stable run can: the error of the energy balance
 * `diagnostics` of the run exceeds ENERGY_FROM_NOWHERE, or breaking bonds released more than RELEASED_FROM_NOWHERE of
 * the largest energy beyond what they had stored. The error is not tested in the first ENERGY_STEPS steps, in which
 * half a step of a load is a large share of the energy, unless the time step of `clock` is above the critical one. */
static bool gains(const struct run_clock *clock, const struct diagnostics *diagnostics)
{
    const bool counts = clock->step >= ENERGY_STEPS || clock->dt > clock->dt_critical;
    return (counts && diagnostics->now.balance_error > ENERGY_FROM_NOWHERE) ||
           diagnostics_bond_energy_release_beyond_stored(diagnostics) >
               RELEASED_FROM_NOWHERE * diagnostics->energy_scale;
}

/* Returns true if the time step of `clock` is above the critical one and velocities change sign in every step: kinetic
 * `energy` < KINETIC_LEAST times strain energy. */
static bool swings(const struct run_clock *clock, const struct energy *energy)
{
    return clock->dt > clock->dt_critical && energy->kinetic < KINETIC_LEAST * energy->strain;
}

/* Returns FAILED, with the message that the run is unstable, step and time of `clock`, and the position of the fastest
 * particle of p. what: text after "the fastest one of a body", such as "whose velocities change sign in every step";
 * remedy: advice at the end of the message. */
static status unstable(const struct particles *p, const struct run_clock *clock, const char *what, const char *remedy)
{
    const int64_t i = fastest_particle(p);
    return status_set(
        FAILED, "unstable at step %lld, t = %.3g s: particle %d at (%s) m is the fastest particle of a body %s; %s",
        (long long)clock->step, clock->t, (int)p->id[i], particle_position_text(p, i, 6).text, what, remedy);
}

/* Elastic strain [1] of points on the grid above which a warning is printed. A strip under tension tears or gains
 * energy at strains above 0.09 with every shape function and transfer (tests/scenes/test_frame.sh). */
#define STRETCH_MOST 0.08

/* Warns that a point on the grid has a strain beyond STRETCH_MOST, with a remedy that the scene s allows. strain:
 * strain of the point [1]; t: time [s]; x: position of the point [m], as text; to: list of warnings. */
static void warn_of_stretched(const struct scene *s, real strain, real t, const char *x, struct warnings *to)
{
    char text[560], remedy[200] = "use mpm.frame: reference";
    const char *why = scene_reason_not_to_advise_total_lagrangian_mpm(s);
    if (why)
        snprintf(remedy, sizeof remedy,
                 "use method: pd, or smaller loads and speeds (mpm.frame: reference is no remedy: %s)", why);
    snprintf(text, sizeof text,
             "points in mpm.frame: current are stretched by %.0f %% at t = %.3g s, near (%s) m: beyond about 10 %% "
             "they separate (mpm.transfer: apic) or gain energy (flip), with any mpm.shape; %s; if this is intended, "
             "add accept: [strain]",
             100 * strain, t, x, remedy);
    warnings_add_and_print(to, text);
}

/* Warns of the first elastic point of p on the grid with a strain (largest principal stress divided by Young's modulus)
 * above STRETCH_MOST, unless the scene s silences this warning. t: present time [s]; to: list of warnings. Returns true
 * if there is such a point. */
static bool say_stretched(const struct particles *p, const struct scene *s, real t, struct warnings *to)
{
    const int n = symmetric_tensor_component_count(p->dim);
    for (int64_t i = 0; i < p->n && p->n_free > 0 && !scene_silences_warning(s, ACCEPT_STRAIN); i++) {
        const struct material *m = &s->material[p->material[i]];
        real stress[SYM_MAX], x[DIM_MAX], sum = 0;
        if (p->kind[i] != KIND_MPM || p->flag[i] & FLAG_MESHED || material_yields(m)) continue;
        for (int c = 0; c < n; c++) stress[c] = p->stress[c][i], sum += square(stress[c]);
        /* cheap bound: the sum is at least half the squared principal stress */
        if (2 * sum < square(STRETCH_MOST * m->young)) continue;
        const real strain = stress_largest_principal(stress, p->dim) / m->young;
        if (!(strain > STRETCH_MOST)) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
        warn_of_stretched(s, strain, t, position_text(x, p->dim, 4).text, to);
        return true;
    }
    return false;
}

/* Equivalent plastic strain of points of a mesh above which a warning is printed [1]. Elastic and plastic strains add
 * up to the strain of the rotated cell (stretch less 1), which differs from the logarithm of the stretch by about half
 * its square. */
#define FLOW_MOST 0.05

/* Warns of the first point of p in a mesh with a plastic strain above FLOW_MOST. t: present time [s]; to: list of
 * warnings. Returns true if there is such a point. */
static bool say_flowed(const struct particles *p, real t, struct warnings *to)
{
    char text[300];
    for (int64_t i = 0; i < p->n && p->mesh_stress[0]; i++) {
        if (!(p->plastic_strain[i] > FLOW_MOST) || !(p->flag[i] & FLAG_MESHED)) continue;
        snprintf(text, sizeof text,
                 "points in mpm.frame: reference have a plastic strain of %.2g at t = %.3g s, near (%s) m: this "
                 "frame adds strains up, so shear beyond 0.04 causes a false tension; use mpm.frame: current",
                 p->plastic_strain[i], t, particle_position_text(p, i, 4).text);
        warnings_add_and_print(to, text);
        return true;
    }
    return false;
}

/* Equivalent plastic strain of points on the grid with a back stress above which a warning is printed [1]. It belongs
 * to a shear g of 0.9, at which the back stress of Prager's law by Jaumann's rate, (C/3) sin g, is 12 % below C g/3
 * (Nagtegaal & de Jong 1981; C: kinematic modulus). */
#define TURNED_MOST 0.5

/* Warns, in 2D and 3D, of the first point of p on the grid whose back stress may oscillate: one with kinematic
 * hardening and a plastic strain above TURNED_MOST. t: present time [s]; to: list of warnings. Returns true if there is
 * such a point. */
static bool say_turned(const struct particles *p, const struct scene *s, real t, struct warnings *to)
{
    char text[360];
    for (int64_t i = 0; i < p->n && p->back_stress[0] && p->dim > 1; i++) {
        if (!(p->plastic_strain[i] > TURNED_MOST) || p->flag[i] & FLAG_MESHED) continue;
        if (!(s->material[p->material[i]].law.kinematic.modulus > 0)) continue;
        snprintf(text, sizeof text,
                 "points with kinematic hardening have a plastic strain of %.2g at t = %.3g s, near (%s) m: beyond a "
                 "shear of about 1 their back stress oscillates (Jaumann's rate), and they carry too little; use "
                 "isotropic hardening, which does not oscillate",
                 p->plastic_strain[i], t, particle_position_text(p, i, 4).text);
        warnings_add_and_print(to, text);
        return true;
    }
    return false;
}

/* Returns FAILED, with a message and a remedy, if the energy shows that the run is unstable although no particle is
 * faster than waves: a body that gains energy, e.g. by breaking all its bonds, or whose velocities change sign in every
 * step; also if an energy is not finite. Warns of large strains, of parted material points and of large motions. Tested
 * at samples and at the end. Bodies whose energy is round-off are not tested. */
status run_check_last_sample_for_energy_divergence(struct run *run)
{
    if (run->stability->lost)
        return status_set(FAILED,
                          "step %lld, t = %.4g s: an energy is not finite, but all positions are: check material, "
                          "supports and initial state (`cleave check`)",
                          (long long)run->clock.step, run->clock.t);
    const struct diagnostics *diagnostics = run->diagnostics;
    const real excess = diagnostics->now.balance_error * diagnostics->energy_scale +
                        diagnostics_bond_energy_release_beyond_stored(diagnostics);
    const bool last = run->clock.step == run->clock.steps && !scene_is_single_equilibrium(run->scene);
    char what[96], remedy[REMEDY_LENGTH];
    if (!run->report->sampling.due && !last) return OK;
    quantity_samples_add_value(&run->stability->excess, run->clock.step, excess);
    if (!run->stability->stretched)
        run->stability->stretched =
            say_stretched(&run->part, run->scene, run->clock.t, &run->warnings) ||
            (scene_is_dynamic(run->scene) && say_flowed(&run->part, run->clock.t, &run->warnings)) ||
            say_turned(&run->part, run->scene, run->clock.t, &run->warnings);
    if (!run->stability->parted)
        run->stability->parted = material_points_warn_of_numerical_fracture(
            &run->stability->pairs, &run->part, &run->cells, run->grid, run->scene, run->clock.t, &run->warnings);
    large_motion_warn_of_self_penetration(&run->stability->motion, &run->part, run->scene, run->source.family.horizon,
                                          run->clock.t, &run->warnings);
    if (scene_is_dynamic(run->scene))
        large_motion_warn_of_non_follower_pressure(&run->stability->motion, &run->part, &run->loads, run->clock.t,
                                                   &run->warnings);
    if (diagnostics_energies_are_only_round_off(diagnostics, run->mass, run->tables.wave_speed)) return OK;
    if (!run->stability->released)
        run->stability->released = fracture_energy_warn_if_negative(run->scene, diagnostics, &run->warnings);
    if (swings(&run->clock, &diagnostics->now.energy)) {
        say_step(run->scene, &run->clock, remedy, sizeof remedy);
        return unstable(&run->part, &run->clock, "whose velocities change sign in every step", remedy);
    }
    if (!gains(&run->clock, diagnostics)) return OK;
    snprintf(what, sizeof what, "with %.0f %% of its energy gained without work of loads",
             100 * excess / diagnostics->energy_scale);
    run_describe_remedy_for_divergence(run, &run->stability->excess, excess, remedy, sizeof remedy);
    return unstable(&run->part, &run->clock, what, remedy);
}
