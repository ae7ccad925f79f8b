"""The columns that figures and report read from each table; a table may have more."""

MAP = (" integrator outer relaxation memory predicted_contraction iterations error_final outer_iterations sweeps "
       "status reason")
METHOD = "scene step_s integrator outer relaxation friction outer_iterations sweeps row_updates wall_s error status reason"
ORDER_ERRORS = "scene integrator alpha outer relaxation step_s error order error_solve error_reference status reason"
SCENES = ("scene step_s duration_s bodies nodes elements most_contacts most_rows steps steps_ok outer_iterations sweeps frame_wall_s "
          "overlap_share overlap_share_at_end bilateral_error_m driven excess_share rest_share judged_steps refuted_steps status reason")
FRAMES = ("scene nodes step_s step time_s tolerance status reason error error_of_scale nearest_start nearest_error_m "
          "nearest_error_of_scale reference reference_status reference_reason reference_residual reference_wall_s "
          "claim_residual")
ORDERS = "scene integrator alpha outer relaxation order order_expected levels step_s error behaviour status reason"
SCHEME = "scene family integrator outer relaxation direction_blend stabilisation "  # of constraints' directions
CONES = ("family number contacts condition law relaxation tolerance natural_residual gap feasibility error_m_per_s "
         "difference_m_per_s sweeps wall_s status reason")

TABLES = {
    ("outer_convergence", "errors"): "scene step_s mass_ratio outer relaxation iteration error status reason",
    ("outer_convergence", "map"):
        "scene step_s mass_ratio outer predicted_rate measured_rate behaviour error_final status reason",
    ("outer_convergence", "residuals"): "scene step_s outer relaxation residual_share outer_iterations status reason",
    ("stability_map", "chain20"): "scene step_s mass_ratio" + MAP,
    ("stability_map", "rods10"): "scene step_s mass_ratio" + MAP,
    ("stability_map", "cantilever"): "scene step_s young_pa" + MAP,
    ("stability_map", "cantilevers"): "scene step_s young_pa" + MAP,
    ("stability_map", "predictions"): "scene step_s mass_ratio predicted_rate predicted_contraction behaviour",
    ("stability_map", "cost"): "scene step_s parameter value measured_rate outer relaxation outer_iterations sweeps row_updates "
                               "wall_s error status reason",
    ("contraction", "rates"): "effect strain step_s stiffness unit load_n predicted_rate stiffening "
                              "predicted_contraction bound measured_rate status reason",
    ("contact_contraction", "rates"): "scene friction step_s sticking sliding margin predicted_rate predicted_contraction "
                                      "measured_rate returns status reason",
    ("direction", "largest_steps"): SCHEME + "largest_step_s predicted_step_s error steps missed_steps "
                                    "most_outer_iterations limit status reason",
    ("direction", "modes"): SCHEME + "mode step_s predicted_left measured_left error row_updates status reason",
    ("direction", "energy"): SCHEME + "step_s time_s energy_j row_updates_per_s status reason",
    ("direction", "equal_work"): SCHEME + "linearisations_per_frame step_s duration_s row_updates_per_s error violation_rms "
                                          "energy_change missed_steps steps status reason",
    ("direction", "contact"): SCHEME + "linearisations_per_frame step_s duration_s row_updates_per_s error violation_rms missed_steps "
                                       "steps status reason",
    ("direction", "contenders"): SCHEME + "step_s of_explicit_limit energy_highest energy_end error row_updates_per_s missed_steps "
                                          "steps status reason",
    ("damping", "decrements"): "scene integrator outer relaxation max_sweeps step_s retardation_s decrement predicted_decrement "
                               "decay_per_s expected_decay_per_s order error row_updates status reason",
    ("damping", "rotation"): "scene integrator outer relaxation step_s retardation_s time_s vibration_j rotation_j drift_j "
                             "row_updates status reason",
    ("inner_convergence", "errors"): "scene relaxation sweep wall_s error status reason",
    ("inner_convergence", "rates"): "scene relaxation predicted_rate measured_rate theory status reason",
    ("contact_convergence", "traces"): "scene law relaxation sweep natural_residual error penetration_m status reason",
    ("contact_convergence", "gaps"): "scene relaxation sweep gap bound status reason",
    ("contact_convergence", "bounds"): "scene relaxation lipschitz bound_share exponent rises sweeps status reason",
    ("contact_convergence", "budgets"): "scene relaxation budget gap natural_residual penetration_m status reason",
    ("contact_convergence", "deformables"): "scene law relaxation contacts rows sweep natural_residual error status reason",
    ("softness", "stretches"): "scene variant relaxation step_s sweeps compliance_m_per_n factor stretch_m expected_m physical_m error "
                               "status reason",
    ("late_friction", "motions"): "scene variant step_s quantity measured expected resolved unit natural_residual penetration_m sweeps "
                                  "steps status reason",
    ("conditioning", "sweeps"): "scene parameter value condition relaxation sweeps residual status reason",
    ("inexact", "solves"): "scene step_s mass_ratio outer relaxation inner_tolerance outer_iterations sweeps row_updates error "
                           "status reason",
    ("dual_vs_primal", "errors"):
        "scene elements young_pa poisson strain outer relaxation sweeps error wall_s status reason",
    ("dual_vs_primal", "final"):
        "scene elements young_pa poisson strain outer relaxation sweeps error wall_s status reason",
    ("mesh_refinement", "beam"): "model n elements h_m quantity value reference_mesh reference_beam error_mesh "
                                 "error_beam status reason",
    ("mesh_refinement", "locking"): "n elements poisson value reference_mesh reference_beam error_mesh error_beam status reason",
    ("mesh_refinement", "mms"): "n h_m error_l2 error_h1 order_l2 order_h1",
    ("fem_vs_springs", "bars"): "model n integrator step_s tip_m tip_beam_m frequency_hz predicted_hz mesh_hz beam_hz left predicted_left "
                                "error predicted_error other_modes status reason",
    ("fem_vs_springs", "courses"): "model n step_s time_s tip_m beam_m status reason",
    ("fem_vs_springs", "networks"): "n kappa poisson lattice_poisson isotropic_poisson status reason",
    ("fem_vs_springs", "cubes"): "model n scene friction_coefficient poisson sag_m sag_expected_m bulge bulge_expected ground_n weight_n "
                                 "off_judge allowed_off_judge judged_steps rows sweeps status reason",
    ("fem_vs_springs", "cost"): "scene model n relaxation tolerance step_s rows outer_iterations sweeps wall_s status reason",
    ("time_order", "errors"): ORDER_ERRORS,
    ("time_order", "orders"): ORDERS,
    ("energy", "series"): "scene integrator alpha outer relaxation step_s time_s energy_j scale_j momentum_kg_m_s "
                          "angular_momentum_kg_m2_s status reason",
    ("energy", "drift"): "scene integrator alpha outer relaxation step_s drift ratio status reason",
    ("energy", "momentum"): "scene integrator alpha outer relaxation max_outer step_s steps steps_ok linear_error angular_error "
                            "angular_unexplained status reason",
    ("energy", "map"): "scene integrator alpha outer relaxation compliance_m_per_n step_s predicted_growth energy_factor status "
                       "reason",
    ("energy", "frontier"): "scene compliance_m_per_n step_s predicted_alpha safe_alpha",
    ("rotation", "errors"): ORDER_ERRORS,
    ("rotation", "orders"): ORDERS,
    ("rotation", "series"): "torque integrator alpha outer relaxation step_s time_s energy_change momentum_change "
                            "momentum_length_change status reason",
    ("rotation", "tumbling"): "disturbance_rad_s integrator alpha outer relaxation step_s period_s exact_s error status reason",
    ("joints", "accuracy"): "mechanism integrator alpha outer relaxation step_s error order joint_error missed_steps wall_s status "
                            "reason",
    ("joints", "lengths"): "relaxation bodies cpu_s_per_step cpu_s_per_sweep exponent_step exponent_sweep status reason",
    ("figure_1", "scenes"): SCENES,
    ("figure_1", "series"): "scene step_s time_s kinetic_energy_j energy_change_j pressing_contacts overlap_m bilateral_error_m "
                            "outer_iterations sweeps residual wall_s status reason",
    ("contact_scenes", "scenes"): SCENES,
    ("figure_1", "frames"): FRAMES,
    ("judged_frames", "frames"): FRAMES,
    ("redundant", "motion"): "relaxation redundant_joints step_s position_difference_m net_force_difference split sweeps "
                             "row_updates missed_steps status reason",
    **{(experiment, "answers"): "quantity scene integrator outer relaxation friction step_s measured expected unit error bound "
                                "sweeps steps missed_steps status reason"
       for experiment in ("incline", "stopping", "restitution", "stack", "coupling")},
    ("friction_isotropy", "headings"): "relaxation friction step_s heading_deg deceleration_share expected_share share_error "
                                       "heading_change_rad heading_error_rad status reason",
    ("convex_gap", "gaps"): "relaxation friction step_s speed_m_per_s gap_m expected_m error sweeps missed_steps status reason",
    ("restitution", "heights"): "relaxation step_s restitution bounce height_m expected_m allowed_m status reason",
    ("stack", "thresholds"): "structure count share outer relaxation friction step_s duration_s moved outcome right sweeps "
                             "missed_steps status reason",
    ("simbenchmark", "accuracy"): "benchmark solver step_s integrator alpha outer relaxation friction error simulated_s "
                                  "missed_steps wall_s cpu_s status reason",  # engines have no counts of iterations
    ("contact_hard_cases", "gates"): "scene step_s integrator outer relaxation friction steps steps_ok sweeps gate measured "
                                     "bound holds status reason",
    ("contact_hard_cases", "frontier"): "scene outer relaxation friction largest_step_s fewest_sweeps status reason",
    ("friction_cone", "contacts"): "law relaxation contact coefficient normal_n_s tangent1_n_s tangent2_n_s slip_m_per_s "
                                   "complementarity_j dissipation_j allowed_j",
    ("friction_cone", "solves"): "law relaxation contacts natural_residual complementarity_share dissipation_share "
                                 "velocity_share sweeps wall_s status reason",
    ("cone_problems", "solves"): CONES,
    ("cone_problems", "large"): CONES,
    ("work_precision", "points"): METHOD + " tolerance",
    ("work_precision", "contacts"): METHOD + " tolerance",
    ("trajectories", "runs"): "scene duration_s step_s integrator outer relaxation friction tolerance count outer_iterations sweeps "
                              "row_updates missed_steps bytes wall_s memory_mb error error_bar energy_error penetration_m truth status reason",
    ("advice", "recommended"): "scene duration_s error_asked step_s integrator outer relaxation tolerance settings error error_bar wall_s "
                          "wall_s_other status reason",
    ("rival_newton", "times"): "scene elements young_pa poisson method error_target iterations setup_s wall_s error status reason",
    ("rival_newton", "traces"): "scene elements young_pa poisson method iteration wall_s error status reason",
    ("large_scenes", "steps"): "scene unit size unknowns method error_target iterations setup_s wall_s memory_mb error status reason",
    ("effects_cost", "costs"): "scene effect rows bytes wall_s wall_s_per_step",
    ("effects_cost", "absent"): "effect case presence time_ratio time_low time_high first_longer_steps bytes_ratio entries_that_differ",
    ("effects_cost", "stripped"): "scene rows wall_s_per_sweep stripped_s_per_sweep ratio ratio_low ratio_high difference",
    ("effects_cost", "scaling"): "scene relaxation rows elements wall_s_per_sweep exponent status reason",
    ("threads", "sweeps"): "scene relaxation threads constraints rows bytes wall_s_per_sweep wall_s_low wall_s_high bytes_per_s "
                           "copied_bytes_per_s share_of_copy speedup same_bits status reason",
    ("threads", "steps"): "scene integrator outer relaxation threads first_step steps wall_s_per_step wall_s_low wall_s_high speedup "
                          "same_bits status reason",
    ("threads", "roofline"): "effect relaxation threads constraints bytes flops wall_s_per_sweep wall_s_low wall_s_high copied_bytes_per_s "
                             "product_flops_per_s share_of_roof status reason",
    ("frame_scaling", "frames"): "scene part size frames missed_frames contacts rows iterations frame_cpu_s begin_cpu_s "
                                 "iteration_cpu_s status reason",
    ("frame_scaling", "exponents"): "scene part quantity exponent low high",
    ("judges", "agreement"): "scene nodes step_s reference_a reference_b difference residual_a residual_b "
                             "wall_s_a wall_s_b status reason",
    ("point_hard_cases", "gates"):
        "scene step_s integrator outer relaxation steps gate measured bound holds status reason",
    ("point_hard_cases", "frontier"): "scene outer relaxation largest_step_s largest_solved_step_s fewest_sweeps "
                                      "runs_passed runs status reason",
    ("generated_scenes", "outcomes"): "relaxation steps claim_largest status reason",
    ("generated_scenes", "sample"): "scene nodes step_s outer relaxation outer_iterations sweeps residual "
                                    "residual_judged claim error reference_status status reason",
    ("generated_worlds", "refuted"): "world variant step check what number bound",
    ("generated_worlds", "broken"): "world kind reason",
    ("generated_worlds", "ends"): "status steps",
    ("generated_worlds", "apart"): "world variant difference turn_rad outcome",
    ("generated_worlds", "agreement"): "variant first_steps outcome",
    ("generated_worlds", "judged"): "world step step_s tolerance error_of_scale nearest_start nearest_error_m nearest_error_of_scale "
                                    "allowed reference_status reference_residual status reason",
    ("tunnelling", "pairs"): "first second continuous scenes hits steps_ok steps_missed steps_turned passed_ok passed_in_touch "
                             "passed_missed status reason",
    ("tunnelling", "passed"): "first second scene step_status",
    (".", "compare"): METHOD + " method",
}
SOLVES = {  # tables of traces, where a solve has many rows: the columns that name one
    ("outer_convergence", "errors"): "scene step_s mass_ratio outer relaxation",
    ("inner_convergence", "errors"): "scene relaxation",
    ("contact_convergence", "traces"): "scene law relaxation",
    ("contact_convergence", "gaps"): "scene relaxation",
    ("contact_convergence", "deformables"): "scene law relaxation",
    ("energy", "series"): "scene integrator alpha step_s",
    ("dual_vs_primal", "errors"): "scene elements young_pa poisson strain outer relaxation",
    ("direction", "energy"): SCHEME,
    ("damping", "rotation"): "scene integrator retardation_s",
    ("rotation", "series"): "torque integrator alpha",
    ("point_hard_cases", "gates"): "scene relaxation",
    ("contact_hard_cases", "gates"): "scene relaxation",
    ("rival_newton", "traces"): "scene elements young_pa poisson method",
}
VERDICTS = "id class statement quantity measured measured_low measured_high bound verdict reason"
OWN_TABLES = ("verdicts", "exponents", "passed", "judged", "recommended", "ends", "refuted", "broken", "apart", "bounds", "budgets")  # shown by the report, never a figure


def columns(experiment, table):
    """The columns needed, none of a table nobody knows."""
    return TABLES.get((experiment, table), "").split()
