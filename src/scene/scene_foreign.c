/* Explains words of other programs, of textbooks and of everyday use that are no keys of a scene: by the equivalent
 * key, or by a note that Cleave has none and which key is nearest. Messages about unknown keys and `cleave help` use
 * this table. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "scene_internal.h"

/* Table of words of other programs. words: alternatives a|b|c. paths: related keys, separated by spaces; the first key
 * is equivalent to the words. text: advice that follows the name of the first key, or, if it begins with =, the whole
 * message; NULL: no advice. */
static const struct foreign {
    const char *words, *paths, *text;
} foreign[] = {
    /* elastic constants, density */
    {"E|E0|young's_modulus|youngs_modulus|young_modulus|youngs|elastic_modulus|elasticity|modulus|stiffness|elastic",
     "material.young", NULL},
    {"nu|poisson's_ratio|poissons_ratio|poisson_ratio|poissons", "material.poisson", NULL},
    {"rho|mass_density|rho0", "material.density", NULL},
    {"K", "material.young material.poisson material.toughness probes.sif",
     "with `poisson`, if K is the bulk modulus: E = 3 K (1 - 2 nu); a critical stress-intensity factor is `toughness`"},
    {"kappa|bulk|bulk_modulus|G|mu|shear|shear_modulus|lame|lame_lambda|lame_mu|lambda",
     "material.young material.poisson", "with `poisson`: E = 9 K G/(3 K + G), nu = E/(2 G) - 1"},
    {"wave_speed|sound_speed|c0", "material.young material.density",
     "with `density` and `poisson`; E = rho c^2 in a bar"},
    /* fracture */
    {"G_c|Gc|gc|GC|g_c|JIc|J_Ic|J_c|G_Ic|G_IC|GIc|GIC|G0|G_f|Gf|fracture_energy|critical_energy_release_rate|energy_"
     "release|griffith|"
     "surface_energy",
     "material.energy_release_rate", "in J/m^2"},
    {"K_Ic|KIc|K_IC|KIC|K1c|K1C|K_c|Kc|fracture_toughness|tenacity", "material.toughness", "as 30 MPa m^0.5"},
    {"s_c|sc|s0|s00|stretch|critical_bond_stretch|max_stretch|critical_strain|failure_strain|fracture_strain|"
     "strain_to_failure|critical_value",
     "material.critical_stretch", "the stretch at which a bond breaks"},
    {"strength|ultimate_strength|ultimate_tensile_strength|failure_stress|fracture_stress|sigma_c|"
     "sigma_t|f_t|ft|UTS|failure|fracture|damage_model|failure_model|breaking",
     "material.tensile_strength material.energy_release_rate material.toughness material.scatter",
     "=with `tensile_strength` bonds soften, and spend `energy_release_rate` in all; without it they break at the "
     "stretch that follows from `energy_release_rate`"},
    {"traction_separation|bilinear|trilinear|damage_evolution|cohesive_law",
     "material.softening material.tensile_strength",
     "=with `tensile_strength`, bonds soften by `softening`: linear, bilinear, exponential"},
    {"damage", "output.fields probes.break probes.tip material.critical_stretch",
     "=damage is a result, the share of broken bonds, in every frame; what breaks bonds is `energy_release_rate`, "
     "`toughness` or `critical_stretch` of the material"},
    {"stress|stresses|strain|strains|sigma|epsilon", "output.fields probes.line boundary.traction",
     "=stress is a result, in every frame, and `output.fields` adds others; on a face it is a load, `traction`; at the "
     "start it follows from initial.displacement_gradient"},
    {"weibull|weibull_modulus|flaws|heterogeneity|random_strength", "material.scatter",
     "as `scatter: {distribution: weibull, modulus: 10}`"},
    {"precrack|pre_crack|pre_cracks|precracks|crack_list|notch|notches|initial_crack|slit|slits|flaw", "cracks", NULL},
    {"tie|tied|cohesive|cohesive_zone|czm|interface|adhesion|adhesive|glue|bonded", "interfaces", NULL},
    {"compression_strength|f_c|fc|crushing_strength|crushing", "material.compressive_strength material.yield_stress",
     "=with `compressive_strength` and `tensile_strength`, bonds begin to soften at a strength surface; Cleave has no "
     "crushing; `yield_stress` limits stress in tension and compression"},
    {"fatigue|cycles|paris|paris_law|n_cycles|s_n_curve", "steps",
     "=Cleave has no fatigue; load steps (`solver: static`, `steps`) follow a crack under one growing load"},
    {"phase_field|length_scale|l0|regularisation|regularization|xfem", "particles.horizon",
     "=Cleave has no phase fields or XFEM: cracks are broken bonds, and the length scale is the horizon, "
     "particles.horizon"},
    {"erosion|element_deletion|deletion|kill", "material.critical_stretch",
     "=Cleave does not delete particles: bonds break (energy_release_rate, toughness or critical_stretch), mass stays"},
    /* yielding */
    {"yield|yielding|yield_strength|yield_point|sigma_y|sigy|plastic|plasticity|von_mises|mises|ductile|j2",
     "material.yield_stress material.yield_tangent material.yield_hardening",
     "with `yield_tangent` or `yield_hardening`"},
    {"hardening_modulus|isotropic_hardening|H|plastic_modulus|strain_hardening",
     "material.yield_hardening material.yield_tangent", NULL},
    {"tangent_modulus|E_t|Et|etan", "material.yield_tangent", NULL},
    {"jc|strain_rate|rate|rate_dependence|strain_rate_hardening|viscoplastic|viscoplasticity|cowper_symonds",
     "material.johnson_cook",
     "=the yield stress depends on rate and temperature by `johnson_cook`, in material points (`method: mpm`)"},
    {"friction_angle|cohesion|dilation_angle|dilatancy|drucker_prager|mohr_coulomb|cap|pressure_dependence|concrete|"
     "soil|sand",
     "material.yield_stress contact.friction",
     "=Cleave has no yielding that depends on pressure (Mohr-Coulomb, Drucker-Prager); nearest: yield_stress (von "
     "Mises), and contact.friction between faces"},
    {"kinematic_hardening|backstress|back_stress|chaboche|prager|armstrong_frederick|bauschinger", "material.kinematic",
     "=`kinematic` has one back stress, with modulus and recall"},
    {"hardness|vickers|vickers_hardness|brinell|rockwell|indentation_hardness", "material.yield_stress",
     "=Cleave has no hardness; nearest: `yield_stress`, about a third of the Vickers hardness of a metal"},
    {"jh|jh1|jh2|jh_1|jh_2|johnson_holmquist|johnson_holmquist_2|jhc|hjc|rht|holmquist|deshpande_evans|ceramic",
     "material.compressive_strength material.tensile_strength",
     "=Cleave has no Johnson-Holmquist, RHT or other law of comminuted ceramics; nearest: bonds that begin to soften "
     "at a strength surface, by `tensile_strength` and `compressive_strength`"},
    {"hardening_curve|hardening_law|plastic_strain|stress_strain_curve|swift|voce|ludwik", "material.hardening", NULL},
    {"melting_temperature|melting_point|melt|Tmelt|Tm|T_m|reference_temperature|room_temperature|T_ref",
     "material.johnson_cook.T_melt material.johnson_cook.T_room",
     "=temperatures are keys of `johnson_cook`, as johnson_cook: {..., T_melt: 1356, T_room: 293}"},
    {"heat_capacity|c_p|cp|thermal_capacity", "material.specific_heat",
     "=plastic work heats a material with `johnson_cook` and `specific_heat`; heat does not flow"},
    /* other physics */
    {"temperature|heat|heating|adiabatic|initial_temperature", "material.johnson_cook material.specific_heat",
     "=heat does not flow and does not expand a body; plastic work heats metals with `johnson_cook` and "
     "`specific_heat`"},
    {"thermal|expansion|thermal_expansion|cte|alpha_t|conductivity|thermal_conductivity|diffusion|cooling",
     "initial.displacement_gradient",
     "=Cleave has no thermal expansion or flow of heat; nearest: a uniform strain at the start, "
     "initial.displacement_gradient"},
    {"orthotropic|orthotropy|anisotropic|anisotropy|transversely_isotropic|fibre|fiber|fibres|fibers|fibre_angle|"
     "fiber_angle|laminate|laminae|composite|E1|E2|E3|E11|E22|E33|nu12|nu13|nu23|G12|G13|G23",
     "parts material.young",
     "=Cleave has no anisotropic materials; nearest: regions of isotropic ones, by materials with parts"},
    {"hyperelastic|neo_hooke|neo_hookean|mooney_rivlin|ogden|C10|D1|rubber|foam", "material.young mpm.strain",
     "=Cleave has no hyperelastic laws; nearest: Hooke's law with large rotations, by young and poisson"},
    {"viscoelastic|viscoelasticity|prony|creep|relaxation_time|maxwell|kelvin_voigt|stiffness_damping|beta",
     "damping material.viscosity",
     "=Cleave has no viscoelasticity or creep; nearest: damping by mass, the key damping"},
    {"eos|equation_of_state|mie_gruneisen|gruneisen|hugoniot|jwl|explosive|detonation",
     "boundary.pressure material.viscosity",
     "=Cleave has no equations of state or explosives; nearest: a pressure that is a function of time, "
     "boundary.pressure"},
    {"fluid|water|pore_pressure|permeability|porosity|biot|hydraulic|fluid_pressure",
     "boundary.pressure boundary.follow",
     "=Cleave has no fluids or pores; nearest: a pressure on faces, boundary.pressure"},
    {"periodic|periodicity|pbc|periodic_boundary", "boundary.mirror",
     "=Cleave has no periodic boundaries; nearest: planes of symmetry, boundary: {mirror: ...}"},
    {"electric|magnetic|piezoelectric|corrosion|hydrogen|moisture|chemistry", "",
     "=Cleave does not compute this: it solves the motion and fracture of solids only"},
    {"shell|shells|beam|beams|truss|plate|membrane", "space thickness",
     "=Cleave has no shells or beams; nearest: space: plane stress, or solid with 4 or more particles across"},
    {"axisymmetric|axisymmetry|axial_symmetry", "space boundary.mirror",
     "=Cleave has no axial symmetry; nearest: space: solid with a quarter of the solid between two mirrors"},
    {"modal|eigenvalue|eigenfrequency|frequency|buckling|eigen", "probes.point",
     "=Cleave does not compute modes; nearest: free vibration recorded by a probe `point`"},
    {"implicit|newmark|hht|newton|newton_raphson|arc_length|riks", "solver steps",
     "=Cleave has no implicit dynamics; solver: static with `steps` follows equilibria, `steps.control` their path"},
    {"title|job|jobname|job_name|heading|header", "name", NULL},
    {"adaptive|coupled|coupling", "method", "as method: adaptive"},
    {"step|stage|load_case|analysis_step", "duration time.step steps",
     "for a run in time; load steps of solver static are `steps`"},
    {"gpu|cuda|device|mpi|ranks|nodes|processes|threads|n_threads|num_threads|cores|cpus", "",
     "=Cleave runs on the cores of one machine; the option -t of `cleave run` sets the number of threads"},
    /* damping, waves */
    {"viscosity|artificial_viscosity|bulk_viscosity|linear_viscosity|quadratic_viscosity|q1|q2", "material.viscosity",
     NULL},
    {"rayleigh|rayleigh_damping|alpha_damping|mass_damping|viscous_damping|dashpot", "damping", NULL},
    {"non_reflecting|nonreflecting|silent|pml|infinite_elements|absorbing_boundary|transmitting", "boundary.absorbing",
     NULL},
    /* discretisation */
    {"dx|h|mesh_size|cellsize|element_size|cell_size|grid_size|resolution|lattice_constant|particle_spacing|n_"
     "particles|num_nodes|discretisation|discretization|node_spacing",
     "particles.spacing", NULL},
    {"lattice|packing|hexagonal|hex|fcc|bcc", "particles.spacing particles.irregularity",
     "=Cleave fills bodies by a square or cubic lattice of particles.spacing; particles.irregularity moves particles "
     "off it"},
    {"delta|horizon_size|horizon_ratio|m_ratio|cutoff|family|neighbour_radius|neighbor_radius", "particles.horizon",
     "in spacings"},
    {"influence_function|weight_function|kernel", "pd.influence", NULL},
    {"dimension|dim|dims|ndim|problem_type|analysis|2d|3d|plane", "space", NULL},
    {"width|depth|area|cross_section", "thickness section",
     "in plane spaces, `section` in space line; sizes of a body are those of its solids"},
    {"element|elements|element_type|element_block|blocks|block|point_set|point_sets", "bodies", NULL},
    {"mesh|mesh_file|input_mesh_file|inp|msh|stl|image", "body solid.mesh particles.spacing",
     "=a file is a shape, as body: {mesh: {file: part.inp, unit: mm}} (also stl, image), filled with particles of "
     "particles.spacing"},
    {"nset|elset|node_set|node_sets|set|sets|group|groups|region", "regions boundary.region",
     "=regions are solids with names (the key regions), or a box, ball, ... where they are used: boundary: [{fixed: "
     "all, region: {box: {from: [0, 0], to: [1 mm, 10 mm]}}}]"},
    {"verlet|velocity_verlet|leap_frog|central_differences|integrator|time_integration|explicit|dynamic|dynamics|"
     "static|statics|quasi_static|quasistatic|run_style",
     "solver", "as explicit (in time), static (load steps) or relaxation (one equilibrium)"},
    {"ppc|ptspercell|points_per_cell|particles_per_cell|matlpts", "mpm.cell",
     "the edge of a cell in spacings: 2 is 4 points in the plane, 8 in space"},
    {"gimp|ugimp|cpdi|shape_function|shape_functions", "mpm.shape", NULL},
    {"pic|flip|apic|xpic|pic_fraction", "mpm.transfer", "as flip or apic"},
    {"mass_scaling", "time.step solver",
     "=Cleave has no mass scaling; solver: static or relaxation finds equilibria without time"},
    {"geometry|domain|part|instance|specimen|sample", "body bodies", "or `bodies`"},
    {"material_model|constitutive|constitutive_model|law|bond_type|pair_style|formulation|lps|pmb", "model", NULL},
    {"sphere", "solid.ball solid.disc", NULL},
    {"circle", "solid.disc solid.ball", "in the plane, as {disc: {centre: [0, 0], radius: 2 mm}}"},
    {"rectangle|cuboid|cube|brick|prism|square", "solid.box", NULL},
    {"hole|holes|void|cutout|difference", "solid.subtract", NULL},
    /* time */
    {"dt|delta_t|timestep|time_step|step_size|fixed_dt|fixed_timestep", "time.step", NULL},
    {"cfl|courant|safety_factor|time_factor|timefactor|stable_step_factor", "time.safety", NULL},
    {"t_end|tend|end_time|final_time|total_time|tmax|t_max|maxtime|simulation_time|stop_time|period|run_time|run|runs|"
     "end|until",
     "duration", NULL},
    {"nsteps|n_steps|num_steps|number_of_steps|timesteps|max_steps|load_steps|increments",
     "duration time.step steps.number", "with time.step; load steps of solver static: steps.number"},
    {"wall_time|walltime|time_limit", "time.wall", NULL},
    /* loads, supports, initial states */
    {"bc|bcs|fix|roller|rollers|disbc|loadbc|velocity_bc|displacement_bc|boundary_condition|boundary_conditions|"
     "boundaries|constraint|constraints|support|supports|dirichlet|encastre|clamp|clamped|pinned|prescribed_"
     "displacement",
     "boundary boundary.fixed boundary.displacement boundary.velocity",
     "a list of {fixed, displacement, velocity, traction, pressure ...}"},
    {"loads|load|cload|dload|dsload|forces|point_force|point_load|neumann|surface_traction|applied_stress",
     "boundary.traction boundary.pressure boundary.body_force bodies.force",
     "on a face; pressure or body_force otherwise, and bodies.force on rigid bodies"},
    {"weight|g|grav|acceleration", "gravity", NULL},
    {"initial_velocity|velocity|velocities|velocity_ic|ic|ics|initial_conditions|initial_condition|v0|impact_velocity",
     "initial.velocity bodies.velocity", "or bodies.velocity for a whole body"},
    {"initial_stress|prestress|pre_stress|residual_stress|initial_strain|prestrain|eigenstrain",
     "initial.displacement_gradient", "a strain of the initial state"},
    {"amplitude|time_function|load_curve|ramp_time", "boundary.time", NULL},
    {"symmetry|symmetric|xsymm|ysymm|zsymm|symmetry_plane", "boundary.mirror", NULL},
    {"friction_coefficient|coefficient_of_friction|coulomb|mu_friction|friction", "contact.friction", NULL},
    {"contact_pair|contact_model|general_contact|short_range_force|short_range|penalty|contact_stiffness|repulsion",
     "contact.stiffness contact.between", NULL},
    {"wall|walls|rigid_wall|obstacle|impactor|projectile|indenter|rigid_body", "bodies.rigid boundary.mirror",
     "a body with rigid: true; a smooth wall is a boundary `mirror`"},
    /* output */
    {"dump|vtk|vtu|paraview|write_frequency|output_frequency|output_interval|archive_time|n_outputs|number_of_output_"
     "steps|outputs|field_output",
     "output.frames output.every output.fields", "or output.every"},
    {"history|history_output|thermo|log|sensors|sensor|gauge|gauges|measure|strain_gauge", "probes output.samples",
     "what is measured; output.samples says how often"},
    {"restart|checkpoint_every|restart_file", "output.checkpoint", "and `cleave run --resume` goes on from it"},
    {"sif|stress_intensity|stress_intensity_factor|stress_intensity_factors|j_integral|jcontour|K_I|K_II|KI|KII|K1|K2",
     "probes.sif", NULL},
    {"crack_speed|tip_speed|crack_tip|crack_path|crack_length", "probes.tip crack.speed_window", NULL},
    {"units|unit_system|unit", "",
     "=Cleave has no unit systems: numbers are SI unless a unit follows them, such as 0.5 mm (`cleave help units`)"},
};

/* Words that people try within a group of keys, where the word alone has another meaning or is the name of another key.
 * group: path of the group, "" for the top of the scene; words: a|b|c; text: the whole message. */
static const struct {
    const char *group, *words, *text;
} foreign_within[] = {
    {"crack", "from|to|at|polygon|width|start|end|points|length|corners|p1|p2",
     "pre-cracks are a list of their own: cracks: [{from: [0, 0], to: [5 mm, 0]}]"},
    {"cracks",
     "start|end|length|a|a0|angle|position|centre|center|points|corners|p1|p2|tip|direction|face|plane|depth|name",
     "a crack is given by its ends, {from: [0, 0], to: [5 mm, 0]}; by {at: ...} in space line, {polygon: ...} in space "
     "solid"},
    {"boundary", "force|forces|load|point_force|point_load|cload|F|P|forcedensity|force_density|b",
     "a force on a face is a traction [Pa], force over area: {traction: [0, 1 MPa], face: y+}; a force per volume is "
     "body_force [N/m^3]"},
    {"boundary", "fix|fixity", "here it is `fixed`, as {fixed: [x], face: x-}; all holds every component"},
    {"boundary", "roller|rollers|slider|sliding",
     "a roller is {fixed: [y], face: y-}, which holds one component; a plane of symmetry is {mirror: {axis: y, at: "
     "0}}"},
    {"contact", "mu|mu_s|mu_k|friction_coefficient|coefficient", "here it is `friction`"},
    {"mpm", "kernel|basis|interpolation|gimp|cpdi|shape_functions", "here it is `shape`"},
    {"probes", "strain|stress|velocity|displacement|acceleration|damage|sensor|gauge|node|position",
     "{point: {at: [0, 0]}} records the motion at a point and {line: ...} a profile; fields are in every frame, more "
     "of them by output.fields"},
    {"boundary", "encastre|clamp|clamped|pinned|support|constraint|held|hold|rigid|xsymm|ysymm|zsymm",
     "a support is {fixed: all, face: x-}, or [x], [y], [z] for some components; a plane of symmetry is {mirror: "
     "{axis: x, at: 0}}"},
    {"boundary", "type|kind|value|values|u|ux|uy|uz|disp|displ|dirichlet|neumann|dof|coordinate",
     "the kind is the key, with its value: {displacement: [1 mm, free], face: x+}; also fixed, velocity, traction, "
     "pressure, body_force, mirror, absorbing"},
    {"boundary", "normal|surface|side|edge|edges|faces", "the outward normal of a face is face: x+, x-, y+ ..."},
    {"boundary", "amplitude|ramp|table|function|history|step|pulse|from|until|to",
     "a function of time is the key time: {ramp: {until: 1 us}}, step, pulse, table or file"},
    {"solid.box",
     "min|max|lower|upper|low|high|lo|hi|start|end|p1|p2|corner|corners|centre|center|origin|size|sizes|length|lengths|"
     "width|height|depth|dimensions|x|y|z|xmin|xmax|ymin|ymax|bounds",
     "a box is given by its lower and its upper corner, as {from: [0, 0], to: [20 mm, 10 mm]}"},
    {"material", "KI|K_I|K1",
     "here it is `toughness`, as 30 MPa m^0.5; the probe `sif` measures K_I of a loaded crack"},
    {"solid.mesh", "size|mesh_size|element_size|h|dx|spacing|resolution",
     "particles.spacing sets the distance of particles; the mesh is the shape that they fill"},
    {"solid.mesh", "scale|units", "the unit of its coordinates is unit: mm"},
    {"material.johnson_cook", "Tm|TM|Tmelt|melt|melting|melting_temperature|melting_point|theta_melt|meltingtemp",
     "here it is `T_melt`"},
    {"material.johnson_cook",
     "Tr|TR|T0|Troom|Tref|T_ref|T_r|room|room_temperature|transition_temperature|theta_transition",
     "here it is `T_room`"},
    {"material.johnson_cook",
     "epsdot0|epsdot_0|eps_dot_0|epsdot|eps_0|epso|e0|edot0|edot|rate0|reference_rate|ref_rate|strain_rate|epsilon0|"
     "rate",
     "here it is `eps0`"},
    {"material.hardening", "swift|ludwik|hollomon|ramberg_osgood|isotropic|bilinear|multilinear|exponential|saturation",
     "the laws here are `linear`, `voce`, `power` and `table`"},
    {"material.johnson_cook", "a|A0|sigma0|sigma_0|sigma_y|yield|yield_stress", "here it is `A`"},
    {"material.johnson_cook", "b|K|hardening|hardening_modulus", "here it is `B`"},
    {"material.johnson_cook", "N|hardening_exponent|exponent", "here it is `n`"},
    {"material.johnson_cook", "c|rate_coefficient", "here it is `C`"},
    {"material.johnson_cook", "M|thermal_exponent|softening_exponent", "here it is `m`"},
    {"material.johnson_cook", "D1|D2|D3|D4|D5|failure|damage|failure_strain",
     "Cleave does not have Johnson and Cook's failure law (D1 to D5): bonds break by energy_release_rate, toughness or "
     "critical_stretch of the material"},
    {"material.johnson_cook", "c_p|cp|specific_heat|taylor_quinney|beta|chi",
     "specific_heat and taylor_quinney are keys of the material, beside johnson_cook"},
    {"time", "end|until|stop|total|duration|tmax|t_max|t_end|final|final_time|end_time",
     "the simulated time is the key `duration`, at the left margin"},
    {"time", "steps|n|number|nsteps|n_steps|num_steps|number_of_steps",
     "the number of steps follows from `duration`, at the left margin, and time.step"},
    {"particles", "dx|h|size|distance|resolution|number|n|radius|count", "their distance is `spacing`"},
    {"particles", "delta|neighbours|neighbors|cutoff|horizon_radius|horizon_size|horizon_ratio|m_ratio",
     "the reach of bonds is `horizon`, in spacings"},
    {"output", "frequency|freq|interval|dt|step|steps",
     "frames are written `every` so often, as every: 1 us, or there are so many `frames` in the run"},
    {"contact", "model|law|type|algorithm|method",
     "contact acts `between` bodies, all or none, with `friction` and `stiffness`"},
    {"material", "model|type|law|constitutive|constitutive_model",
     "the keys of a material say what it does: young and poisson, energy_release_rate, yield_stress, hardening, "
     "johnson_cook; bonds have their model by the key `model`, at the left margin"},
};

/* Values that people give a key although it has another meaning. path: path of the key; words: a|b|c, or * for all
 * values; text: advice that follows the message. */
static const struct {
    const char *path, *words, *text;
} foreign_values[] = {
    {"space", "2d|2D|2|plane|two_dimensional",
     "a thin plate is plane stress, a cross-section of a thick body plane strain"},
    {"space", "3d|3D|3|three_dimensional|volume|full", "three dimensions are solid"},
    {"space", "1d|1D|1|bar|rod|one_dimensional|uniaxial", "one dimension is line"},
    {"space", "axisymmetric|axisymmetry|axial_symmetry|axi",
     "Cleave has no axial symmetry; nearest: solid, with a quarter of the body between two boundaries `mirror`"},
    {"model", "pmb|bpd|bb|bbpd|bond_based|prototype_microelastic_brittle|peri/pmb",
     "the bond-based model (peri/pmb of LAMMPS) is bond"},
    {"model", "lps|osb|osbpd|osb_pd|ordinary|ordinary_state_based|linear_peridynamic_solid|peri/lps",
     "the ordinary state-based model (peri/lps of LAMMPS) is ospd"},
    {"steps", "*",
     "100 load steps are steps: {number: 100}; the number of time steps follows from duration and time.step"},
    {"material.tensile_strength", "inf|infinite|infinity|none",
     "leave the key out for bonds that break without softening"},
    {"boundary.traction", "*", "a load along the normal is `pressure`, a number, positive inwards"},
    {"model", "correspondence|nosb|nosbpd|nosb_pd|non_ordinary|state_based|neo_hookean|elastic|linear_elastic",
     "Cleave has no correspondence or other laws of bonds; nearest: mospd"},
    {"solver", "implicit|newmark|hht|newton|newton_raphson|arc_length|quasi_static|quasistatic",
     "Cleave has no implicit dynamics; static, with load steps, follows equilibria"},
    {"contact.stiffness", "*", "it is a factor of the stiffness of the bonds, not a stiffness in N/m or N/m^3"},
    {"crack", "*", "pre-cracks are the key `cracks`: cracks: [{from: [0, 0], to: [5 mm, 0]}]"},
    {"time", "*", "the simulated time is the key `duration`, and the time step is time: {step: 1 ns}"},
};

/* Returns true if `word` equals the first `length` characters of `text`. A - or a blank in `word` counts as _; words
 * longer than two letters are compared without regard to case. */
static bool word_is(const char *word, const char *text, size_t length)
{
    if (strlen(word) != length) return false;
    for (size_t k = 0; k < length; k++) {
        const char c = word[k] == '-' || word[k] == ' ' ? '_' : word[k];
        const bool same_letter = length > 2 && tolower((unsigned char)c) == tolower((unsigned char)text[k]);
        if (c != text[k] && !same_letter) return false;
    }
    return true;
}

/* Returns true if `word` is one of the alternatives in `words`, a text of the form a|b|c. */
static bool words_have(const char *words, const char *word)
{
    bool has = false;
    for (const char *c = words; *c && !has;) {
        const size_t length = strcspn(c, "|");
        has = word_is(word, c, length);
        c += length + (c[length] == '|');
    }
    return has;
}

/* Returns the row of the table `foreign` (words of other programs) that contains `word`, or NULL. */
static const struct foreign *foreign_row(const char *word)
{
    for (size_t k = 0; k < COUNT_OF(foreign); k++)
        if (words_have(foreign[k].words, word)) return &foreign[k];
    return NULL;
}

bool other_program_keyword_write_advice(const char *foreign_word, const char *group, char *text, size_t capacity)
{
    if (isdigit((unsigned char)*foreign_word))
        return snprintf(text, capacity, "a comma separates keys here; the decimal sign is a point, as in 1.5 mm"), true;
    for (size_t k = 0; k < COUNT_OF(foreign_within) && *group; k++)
        if (strcmp(foreign_within[k].group, group) == 0 && words_have(foreign_within[k].words, foreign_word))
            return snprintf(text, capacity, "%s", foreign_within[k].text), true;
    const struct foreign *row = foreign_row(foreign_word);
    if (!row) return false;
    if (row->text && *row->text == '=') return snprintf(text, capacity, "%s", row->text + 1), true;
    const size_t length = strcspn(row->paths, " "), within = strlen(group);
    const bool here = within > 0 && !strncmp(row->paths, group, within) && row->paths[within] == '.' &&
                      !memchr(row->paths + within + 1, '.', length - within - 1);
    const char *name = here ? row->paths + within + 1 : row->paths;
    if (!strncmp(name, "solid.", 6)) name += 6;
    snprintf(text, capacity, "here it is `%.*s`%s%s", (int)strcspn(name, " "), name, row->text ? ", " : "",
             row->text ? row->text : "");
    return true;
}

const char *other_program_value_get_advice(const char *key_path, const char *foreign_value)
{
    for (size_t k = 0; k < COUNT_OF(foreign_values); k++) {
        const char *words = foreign_values[k].words;
        if (strcmp(foreign_values[k].path, key_path) != 0) continue;
        if (!strcmp(words, "*") || words_have(words, foreign_value)) return foreign_values[k].text;
    }
    return NULL;
}

const char *other_program_keyword_get_equivalent_keys(const char *foreign_word)
{
    const struct foreign *row = foreign_row(foreign_word);
    return row ? row->paths : NULL;
}
