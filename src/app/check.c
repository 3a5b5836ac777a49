/* Implements `cleave check`: checks an input file and estimates the cost of its run by trial steps. It writes no
 * file. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/busy.h"
#include "base/memory_stream.h"
#include "check_parts.h"
#include "commands.h"
#include "engine/engine.h"
#include "mesh/mesh_part.h"
#include "contact/contact.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "run/say.h"
#include "scene/scene_read.h"
#include "study/pilot.h"

static void say_particles(const struct run *run)
{
    int64_t driven = 0;
    for (int64_t i = 0; i < run->part.n; i++) driven += (run->part.flag[i] & FLAG_DRIVEN) != 0;
    printf("particles      %lld", (long long)run->part.n_body);
    if (run->part.n < run->part.n_body) printf(", of which %lld are made", (long long)run->part.n);
    printf(": %lld peridynamic, %lld material points", (long long)run->part.n_of[KIND_PD],
           (long long)run->part.n_of[KIND_MPM]);
    if (driven) printf("; %lld driven", (long long)driven);
    if (run->loads.images) printf("; %lld mirror images", (long long)run->loads.images);
    printf("\nbonds          %lld directed in %lld rows\n", (long long)run->bonds.n, (long long)run->bonds.rows);
}

static void say_frames(const struct run *run)
{
    for (int b = 0; b < run->scene->bodies; b++)
        if (run->frame->choice[b].reason)
            printf("frame          body %s: %s frame (%s)\n", run->scene->body[b].name,
                   run->frame->choice[b].reference ? "reference" : "current", run->frame->choice[b].reason);
    if (run->frame->mesh.points > 0)
        printf("mesh           %lld material points in the reference frame, with linear grid cells of two spacings\n",
               (long long)run->frame->mesh.points);
}

/* Prints the names of the bodies of scene s (the input file) with the indices `from` to end - 1: the first six, and the
 * number of further ones. Joined bodies are printed as one name a+b. */
static void say_names(const struct scene *s, int from, int end)
{
    enum { NAMED = 6 };
    const char *between = "";
    int n = 0;
    for (int b = from; b < end; b++) {
        if ((b < s->bodies && s->body[b].joined != b) || ++n > NAMED) continue;
        printf("%s%s", between, s->body[b].name);
        for (int k = b + 1; k < s->bodies && b < s->bodies; k++)
            if (s->body[k].joined == b) printf("+%s", s->body[k].name);
        between = ", ";
    }
    if (n > NAMED) printf(" and %d more", n - NAMED);
}

/* Prints between which peridynamic bodies and rigid bodies of scene s (the input file) contact acts, whether with
 * themselves, and the contact law and friction. Prints nothing for an input file without contact. */
static void say_contact_of_bonds(const struct scene *s)
{
    if (s->contact_between == CONTACT_NONE && s->rigids == 0) return;
    printf("contact        of ");
    say_names(s, 0, s->bodies);
    if (s->contact_between == CONTACT_ALL)
        printf(" %swith itself (fragments, faces of cracks)", s->bodies > 1 ? "with each other and " : "");
    if (s->contact_between == CONTACT_BODIES) printf(" with each other, not with itself");
    if (s->rigids > 0) {
        printf("%s with rigid ", s->contact_between == CONTACT_NONE ? "" : ", and");
        say_names(s, s->bodies, s->bodies + s->rigids);
        if (s->rigids > 1) printf(" (there is no contact between rigid bodies)");
    }
    printf("; %s", s->contact_form == CONTACT_PAIR ? "forces between pairs of particles (sliding faces interlock)"
                                                   : "smooth faces");
    if (s->contact_friction > 0)
        printf(", coefficient of friction %.3g (the lattice adds about 0.007)", s->contact_friction);
    putchar('\n');
}

/* Prints the share of contact in the time of the first steps, and by how much contact shortens the time step. Prints
 * nothing for load steps, or if no particle is near a face. c: cost of the run, estimated from trial steps. */
static void say_contact_cost(const struct run *run, const struct cost *c)
{
    const struct run_clock *clock = &run->clock;
    const double shorter = clock->dt / (run->scene->safety * clock->dt_critical);
    if (scene_has_load_steps(run->scene) || !(c->contact > 0) || run->contact->rows == 0) return;
    printf("contact        %lld of %lld particles are near a face and checked for contact, which takes about %.1f %% "
           "of the time of the first steps",
           (long long)run->contact->rows, (long long)run->part.n, 1e2 * fmin(1, c->contact));
    if (run->scene->time_step == 0 && shorter < 0.999)
        printf("; the time step is %.2f times that without contact", shorter);
    putchar('\n');
}

static void say_contact(const struct run *run)
{
    int on_grid = 0;
    if (run->scene->method != METHOD_MPM) say_contact_of_bonds(run->scene);
    for (int b = 0; b < run->scene->bodies; b++)
        on_grid += run->scene->method != METHOD_PD && !run->frame->choice[b].reference;
    if (on_grid < 2) return;
    if (run->grid->fields < 2)
        printf("contact        material points of touching bodies share grid nodes, so the bodies stick together until "
               "a gap of two cells opens\n");
    else {
        printf("contact        of the material points of ");
        say_names(run->scene, 0, run->scene->bodies);
        printf(" with each other, on a grid for each");
        if (run->scene->contact_friction > 0) printf(", friction %.3g", run->scene->contact_friction);
        putchar('\n');
    }
}

/* Prints how the first six pre-cracks of the run are represented, as slits of the mesh (doubled nodes) or as cut bonds,
 * and the number of further pre-cracks, if any. */
static void say_notches(const struct run *run)
{
    enum { SAID = 6 };
    const int n = run->coupling->notches.n;
    char text[256];
    for (int k = 0; k < n && k < SAID; k++) {
        notch_describe_as_slit_or_cut_bonds(&run->coupling->notches, k, run->scene->spacing, text, sizeof text);
        printf("notch          crack %d: %s\n", k + 1, text);
    }
    if (n > SAID) printf("notch          and %d more\n", n - SAID);
}

static void say_time_step(const struct run *run)
{
    if (scene_has_load_steps(run->scene))
        print_load_step_settings(run);
    else if (scene_is_single_equilibrium(run->scene))
        printf("solver         static equilibrium to a residual of %.3g of the load, in at most %lld iterations\n",
               run->scene->solver_tolerance, (long long)run->clock.steps);
    else
        printf("time step      %.4g s%s, %.2f times the critical time step of %.4g s; %lld steps to t = %.4g s\n",
               run->clock.dt, run->scene->time_step > 0 ? " (time.step, regardless of time.safety)" : "",
               run->clock.dt / run->clock.dt_critical, run->clock.dt_critical, (long long)run->clock.steps,
               run->scene->duration);
}

/* Prints the end of the line with the estimated run time of `scene`: which steps were measured (all steps of a run with
 * larger particles, or only the first steps), and the run time if all particles were peridynamic. c: estimated cost. */
static void say_basis(const struct scene *scene, const struct cost *c)
{
    if (c->basis == COST_SCALED)
        printf("; a step of the whole run takes on average %.3g times as long as the first steps, as measured with "
               "%.3g times the spacing",
               c->growth, c->coarser);
    if (c->basis == COST_FIRST)
        printf("; this estimate assumes that all steps take as long as the first ones%s",
               scene->method == METHOD_ADAPTIVE ? ", and steps take longer as particles convert" : "");
    if (c->all_peridynamic > 0) printf("; %.2g s if all of it were peridynamic", c->all_peridynamic);
}

/* Factors for the bounds of the time per step of a static equilibrium: from estimate/REST_BELOW to estimate *
 * REST_ABOVE. The estimate covers only the time of the forces. Plates of 10,000 and 80,000 particles with a crack took
 * up to 4.3 times as long, with both solvers on a busy machine. */
#define REST_BELOW 1.5
#define REST_ABOVE 4.5

/* Prints the run time of the static equilibrium of the run on `threads` threads. The solver runs until it converges, so
 * that the number of its steps is not known in advance. Therefore prints the time of 1000 steps with a lower and an
 * upper bound, and an upper bound for the largest number of steps that the input file allows. c->step: measured time of
 * one step [s]. */
static void say_cost_at_rest(const struct run *run, const struct cost *c, int threads)
{
    const double thousand = 1e3 * c->step;
    printf("run time       about %.2g s for 1000 steps (%.2g to %.2g s), up to %.2g s for the largest number of steps, "
           "%lld, on %d thread%s",
           thousand, thousand / REST_BELOW, thousand * REST_ABOVE, c->step * REST_ABOVE * (double)run->clock.steps,
           (long long)run->clock.steps, threads, threads > 1 ? "s" : "");
}

static void say_cost(const struct run *run, const struct cost *c, int threads)
{
    const char *many = threads > 1 ? "s" : "";
    if (scene_has_load_steps(run->scene))
        print_load_steps_cost(run, c, threads);
    else if (scene_is_single_equilibrium(run->scene))
        say_cost_at_rest(run, c, threads);
    else {
        const bool grows = c->basis == COST_FIRST && run->scene->method == METHOD_ADAPTIVE;
        printf("run time       %s %.2g s (%.2g to ", grows ? "at least" : "about", c->run, c->least);
        if (isfinite(c->most))
            printf("%.2g s)", c->most);
        else
            printf("any time)");
        printf(" on %d idle core%s, of which %.1g s for writing files; the first steps take %.3g ns per particle",
               threads, many, c->output, 1e9 * c->step / (double)run->part.n);
        say_basis(run->scene, c);
    }
    printf("\nmemory         about %.0f MB\n", 1e-6 * c->bytes);
}

/* Prints, as part of a sentence, the smallest and largest random factor on the strength [1] over the particles p of
 * material number `material`. */
static void say_scatter(const struct particles *p, int material)
{
    real least = INFINITY, most = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->material[i] != material) continue;
        least = real_min(least, p->strength[i]), most = real_max(most, p->strength[i]);
    }
    if (most > 0) printf(", both by factors of %.3g to %.3g", least, most);
}

/* Returns true if an interface of scene s (the input file) with an energy release rate of its own joins a body of
 * material number m. */
static bool breaks_at_interface(const struct scene *s, int m)
{
    bool breaks = false;
    for (int k = 0; k < s->interfaces; k++)
        for (int end = 0; end < 2; end++)
            breaks |= s->interface[k].critical_stretch > 0 &&
                      scene_body_can_have_material(&s->body[s->interface[k].body[end]], m);
    return breaks;
}

/* Prints a line for each interface of scene s (the input file) with an energy release rate of its own: the stretch at
 * which its bonds break. */
static void say_interfaces(const struct scene *s)
{
    for (int k = 0; k < s->interfaces; k++) {
        const struct scene_interface *i = &s->interface[k];
        if (i->critical_stretch > 0)
            printf("interface      %s and %s: bonds break at a stretch of %.4g (energy release rate %.4g J/m^2)\n",
                   s->body[i->body[0]].name, s->body[i->body[1]].name, i->critical_stretch, i->energy_release_rate);
    }
}

static void say_materials(const struct run *run)
{
    for (int m = 0; m < run->scene->materials; m++) {
        const struct material *a = &run->scene->material[m];
        const bool in_steps = scene_has_load_steps(run->scene);
        if (in_steps)
            printf("material       %s: Young's modulus %.4g Pa", a->name, a->young);
        else
            printf("material       %s: waves at %.4g m/s", a->name, a->wave_speed);
        if (!in_steps && a->rayleigh_speed > 0) printf(", Rayleigh %.4g m/s", a->rayleigh_speed);
        if (material_has_softening_bonds(a))
            printf(", bonds soften");
        else if (isfinite(a->critical_stretch))
            printf(", bonds break at a stretch of %.4g", a->critical_stretch),
                print_tensile_strength_of_brittle_bonds(run->scene, a);
        else
            printf("; its bonds %s: neither energy_release_rate nor critical_stretch is given",
                   breaks_at_interface(run->scene, m) ? "break only at the interface" : "never break");
        const real most = run->tables.elastic[m].trigger_mean;
        if (isfinite(most)) printf(", conversion above %.4g Pa", most);
        if (isfinite(most) && material_has_strength_surface(a))
            printf(" or at %.3g of the strength surface", run->scene->conversion.alpha);
        if (run->part.strength && a->scatter.given) say_scatter(&run->part, m);
        printf("\n");
        print_softening_and_horizon_limits(run->scene, a);
    }
}

/* Returns true if the texts a and b are equal except for the numbers in them. */
static bool texts_alike(const char *a, const char *b)
{
    static const char number[] = "0123456789.+-e";
    do {
        a += strspn(a, number), b += strspn(b, number);
        if (*a != *b) return false;
    } while (*a++ && *b++);
    return true;
}

/* Appends to *found the warnings in `trial`, which trial steps (steps that only measure the cost) have raised. A
 * warning is omitted if it differs from one in *found only by its numbers, such as the time. */
static void warnings_of_trial(struct warnings *found, const struct warnings *trial)
{
    for (int k = 0; k < trial->n; k++) {
        bool there = false;
        for (int m = 0; m < found->n; m++) there |= texts_alike(found->text[m], trial->text[k]);
        if (!there) warnings_add_if_new(found, "%s", trial->text[k]);
    }
}

/* Prints a line if other programs and this run together need more cores than the machine has, so that the run takes
 * longer. load: load average of the machine before the trial steps, since the steps themselves raise it [processes];
 * threads: number of threads of the run. */
static void say_busy(double load, int threads)
{
    char text[256];
    if (machine_compose_warning_if_overloaded(text, sizeof text, load, machine_physical_core_count(), threads))
        printf("load           %s\n", text);
}

/* Estimates run time and memory of the run by trial steps and prints both. a: arguments from which the run was made, so
 * that other input files can be made for comparison; threads: number of threads, which is printed; made: processor time
 * of the set-up of the run [s]. Appends the warnings of the trial steps to *found. The run cannot be used afterwards.
 * Returns FAILED if one of the first steps fails. */
static status check_cost(struct run *run, const struct run_arguments *a, int threads, double made,
                         struct warnings *found)
{
    struct cost cost = {.make = made};
    const double load = machine_load_average();
    const status result = run_cost_measure_by_trial_steps(&cost, run, a);
    warnings_of_trial(found, &cost.found);
    warnings_free(&cost.found);
    TRY(result);
    say_contact_cost(run, &cost);
    say_cost(run, &cost, threads);
    say_busy(load, threads);
    print_cost_saved_by_coarse_cells(run, &cost);
    return OK;
}

/* Prints the texts of the list `lines`, one per line: the first after `heading`, the others, indented, on the lines
 * below. Prints nothing if the list is empty. */
static void say_list(const struct warnings *lines, const char *heading)
{
    for (int k = 0; k < lines->n; k++) printf("%-15s%s\n", k == 0 ? heading : "", lines->text[k]);
}

/* Prints the remarks on the accuracy of the input file of the run. *remarks: receives their number. Returns FAILED,
 * with a message, if there is no memory for them. */
static status say_accuracy(const struct run *run, int *remarks)
{
    char *text = NULL;
    size_t length;
    FILE *out = memory_stream_open(&text, &length);
    if (!out)
        return status_set(FAILED,
                          "out of memory: the remarks on accuracy are not printed; use a larger particles.spacing");
    print_accuracy_advice(run, out);
    const status written =
        fclose(out) == 0
            ? OK
            : status_set(FAILED,
                         "out of memory: the remarks on accuracy are not printed; use a larger particles.spacing");
    *remarks = 0;
    for (const char *line = text; written == OK && *line; line = strchr(line, '\n') + 1) ++*remarks;
    if (written == OK) fputs(text, stdout);
    free(text);
    return written;
}

/* Prints the verdict on an input file: sound, or fit to run after the warnings and remarks on accuracy have been read.
 * scene: file name; warnings, remarks: numbers of warnings and remarks printed above. */
static void say_verdict(const char *scene, int warnings, int remarks)
{
    const struct printable_name shown = printable_name(scene);
    const char *name = shown.text;
    if (warnings == 0 && remarks == 0)
        printf("%s is sound\n", name);
    else if (warnings == 0)
        printf("%s can be run; read first the remark%s on accuracy above (%d in all)\n", name, remarks > 1 ? "s" : "",
               remarks);
    else
        printf("%s can be run, but read first the warning%s above (%d in all)%s\n", name, warnings > 1 ? "s" : "",
               warnings, remarks > 0 ? " and the remarks on accuracy" : "");
}

/* Prints the resolved settings of the input file of the run: particles, shapes, materials, positions at which shape
 * functions are evaluated, pre-cracks, loads, steps, contact. */
static void say_settings(const struct run *run)
{
    say_particles(run);
    print_volume_filled_by_particles(run);
    print_shape_file_volumes(run);
    print_bodies_in_several_unbonded_pieces(run);
    say_materials(run);
    say_interfaces(run->scene);
    print_smallest_resolvable_precrack_length(run);
    say_frames(run);
    print_coarse_cell_sizes_and_counts(run);
    say_notches(run);
    print_loads_and_supports(run);
    say_time_step(run);
    say_contact(run);
}

/* Sets up a run of scene s (the input file) and prints its resolved settings, remarks on its accuracy, the cost (only
 * if `trial`), hints, the warnings (on standard error), and the verdict. a: arguments from which s was read; threads:
 * number of threads; start: time on thread_cpu_clock_seconds at which the reading of the input file began [s]. Changes
 * settings of s. Returns REFUSED or FAILED, with a message, if the set-up or a trial step fails. */
static status check_sound(struct scene *s, const struct run_arguments *a, int threads, double start, bool trial)
{
    struct run e = {0};
    struct warnings hints = {0}, found = {.locate = scene_find_file_location_of_warning, .scene = s};
    int remarks = 0;
    s->active_set = false;           /* cost with the whole body active */
    s->accept |= 1u << ACCEPT_SHOCK; /* trial steps stay silent about collisions that advise_shocks announces */
    run_print_notice_if_set_up_takes_long(s);
    status result = run_set_up_from_scene(&e, s, NULL);
    const double made = thread_cpu_clock_seconds() - start;
    if (result == OK) {
        say_settings(&e);
        run_warn_of_suspicious_input(&e);
        warn_that_bond_plasticity_is_not_von_mises(e.scene, &e.warnings);
        warnings_append_missing_from_list(&found, &e.warnings, 0);
        hint_needless_cost_and_unused_settings(&e, &hints);
        result = say_accuracy(&e, &remarks);
        if (result == OK && trial) result = check_cost(&e, a, threads, made, &found);
        say_list(&hints, "hints");
        fflush(stdout); /* warnings follow what is printed so far, and precede the verdict */
        warnings_print(&found, 0, stderr);
        if (result == OK) say_verdict(a->scene, found.n, remarks);
    }
    warnings_free(&hints);
    warnings_free(&found);
    run_free_memory(&e);
    return result;
}

status command_check_main(int argc, char **argv)
{
    struct run_arguments a;
    struct pilot_requirements pilot;
    const bool trial = !arguments_remove_option(&argc, argv, "--no-trial");
    TRY(arguments_read(&a, argc, argv, "check " CHECK_WORDS));
    const int threads = threads_set_count_and_bind_to_cores(a.threads);
    const double start = thread_cpu_clock_seconds();
    struct scene s = {0};
    status result = scene_read_unless_pilot_runs_are_needed(&s, &pilot, a.scene, a.override, a.overrides);
    if (result == OK && pilot.wanted) {
        result = pilot_runs_print_plan(&pilot, a.scene, stdout);
        scene_free(&pilot.provisional);
    } else if (result == OK) {
        result = check_sound(&s, &a, threads, start, trial);
        scene_free(&s);
    }
    arguments_free(&a);
    return result;
}
