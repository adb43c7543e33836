// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/run/result_tables.h>

#include <cmath>

namespace strait
{
  Condition
  with_threshold(const Scene &scene)
  {
    return {"with `Load programme/Find threshold`", scene.programme.find_threshold};
  }

  Table<Transition>
  threshold_table(const Scene &scene)
  {
    Table<Transition> table("threshold.csv",
                            with_threshold(scene),
                            "One row for each slip length; loads are nominal pressures.");
    table
      .add(&Transition::lower,
           "critical_load_lower [pressure]: largest load known to leak, below the "
           "critical load L_c")
      .add(&Transition::upper,
           "critical_load_upper [pressure]: smallest load known to seal, above L_c")
      .add(
        &Transition::grid_error,
        "critical_load_error [1]: estimated relative shift of L_c by finer points: the 1 "
        "− L/L_c at which half a spacing is left along the throat. In windows and where "
        "states depend on the load path, three times the change from every second point "
        "to all is added, or half of that from every fourth to every second point if "
        "that is more. Elsewhere it is three times that change if the change itself "
        "exceeds three times the estimate on every second point. `nan` where states "
        "depend on the path, without `Output/Error budget` or `Contact/Zoom`, and where "
        "every second point is needed of an odd number or of fewer than 64; `inf` in a "
        "crease at the edges of a sphere's box or of a mirrored map, which only the "
        "spacing of the points lets close")
      .add(&Transition::contact_area,
           "contact_area [1]: fraction in contact at `critical_load_lower`")
      .add([](const Transition &t) { return t.bottleneck[0]; },
           "x [length]: x of the last constriction at `critical_load_lower`")
      .add([](const Transition &t) { return t.bottleneck[1]; },
           "y [length]: y of the same point")
      .add(&Transition::slip_length, "slip_length [length]: slip length d0")
      .add(&Transition::n_solves, "contact_solves [1]: loads that the search tried")
      .add(&Transition::fft_pairs,
           "fft_pairs [1]: pairs of Fourier transforms of these solves");
    return table;
  }

  Table<Step>
  constriction_table(const Scene &scene)
  {
    Table<Step> table("constrictions.csv",
                      with_threshold(scene),
                      "One row for each step that leaks: the constrictions at which the "
                      "pressure drops.");
    table.add(&Step::number, "step [1]: as in leakage.csv")
      .add([](const Step &step) { return step.state.contact->nominal_pressure; },
           "pressure [pressure]: nominal pressure")
      .add([](const Step &step) { return step.state.control.slip_length; },
           "slip_length [length]: slip length d0")
      .add([](const Step &step) { return step.reduced_load.value_or(std::nan("")); },
           "reduced_load [1]: 1 − L/L_c")
      .add([](const Step &step) { return step.place_of_bottleneck()[0]; },
           "x [length]: x of the throat, the narrowest point of the path of least "
           "resistance")
      .add([](const Step &step) { return step.place_of_bottleneck()[1]; },
           "y [length]: y of the same point")
      .add([](const Step &step) { return step.flow->channel.throat.gap; },
           "gap [length]: gap g0 of the throat there")
      .add([](const Step &step) { return step.flow->channel.throat.length; },
           "length [length]: length of the throat along the channel, over which the gap "
           "doubles")
      .add([](const Step &step) { return step.flow->channel.throat.width; },
           "width [length]: width of the throat across the channel, at which the gap "
           "would vanish")
      .add([](const Step &step) { return step.flow->constrictions->points_along; },
           "points_along [1]: `length` of the throat in grid spacings")
      .add([](const Step &step) { return step.flow->constrictions->fraction_at_worst; },
           "share_of_worst [1]: largest part of the pressure drop that falls at one "
           "constriction")
      .add([](const Step &step) { return step.flow->constrictions->n_constrictions; },
           "constrictions [1]: number of constrictions along the path")
      .add([](const Step &step) { return step.flow->constrictions->n_for_90_percent; },
           "constrictions_for_90_percent [1]: fewest constrictions that carry 90 % of "
           "the pressure drop");
    return table;
  }

  Table<BlowOut>
  blow_out_table(const Scene &scene)
  {
    Table<BlowOut> table("blow_out.csv",
                         {"with `Load programme/Find blow-out`",
                          scene.programme.find_blow_out},
                         "One row for each of `Pressures`.");
    table.add(&BlowOut::load, "pressure [pressure]: nominal pressure, the load")
      .add([](const BlowOut &found) { return found.opening.lower; },
           "blow_out_pressure_lower [pressure]: largest inlet pressure known to be held "
           "when it is raised at this load")
      .add(
        [](const BlowOut &found) { return found.opening.upper; },
        "blow_out_pressure_upper [pressure]: smallest inlet pressure known to leak then; "
        "0 or the outlet's if the seal leaks by itself")
      .add([](const BlowOut &found) { return found.opening.contact_area; },
           "contact_area [1]: fraction in contact at `blow_out_pressure_lower`")
      .add([](const BlowOut &found) { return found.opening.bottleneck[0]; },
           "x [length]: x of the point that opens")
      .add([](const BlowOut &found) { return found.opening.bottleneck[1]; },
           "y [length]: y of the same point")
      .add([](const BlowOut &found) { return found.opening.n_solves; },
           "solves [1]: solves of contact and flow")
      .when({"with `Find re-sealing`", scene.programme.find_resealing})
      .add([](const BlowOut &found) { return found.closing->lower; },
           "resealing_pressure_lower [pressure]: largest inlet pressure known to be held "
           "when it is lowered from where the seal leaks. Both bounds are 0 or the "
           "outlet's if the seal stays open, and `nan` if adhesive walls part as soon as "
           "it leaks")
      .add([](const BlowOut &found) { return found.closing->upper; },
           "resealing_pressure_upper [pressure]: smallest inlet pressure known to leak "
           "when it is lowered")
      .when({"with `Output/Error budget`", scene.output.error_budget})
      .add([](const BlowOut &found) { return found.opening.grid_error; },
           "blow_out_pressure_error [1]: estimated relative shift of the blow-out "
           "pressure by finer points: three times the change from every second point to "
           "all or, if that is more, half of that from every fourth to every second "
           "point; `nan` if these give no estimate")
      .when({"with `Output/Error budget` and `Find re-sealing`",
             scene.output.error_budget && scene.programme.find_resealing})
      .add([](const BlowOut &found) { return found.closing->grid_error; },
           "resealing_pressure_error [1]: likewise for the re-sealing pressure");
    return table;
  }

  Table<Jump>
  jump_table(const Scene &scene)
  {
    // After a pull-off there is no state.
    const auto after = [](double PathPoint::*value) {
      return [value](const Jump &jump) {
        return jump.is_pull_off() ? std::nan("") : jump.after.*value;
      };
    };
    Table<Jump> table(
      "jumps.csv",
      {"with adhesion", scene.contact.enabled && scene.contact.adhesion.enabled},
      "One row for each jump on the way from load to load, between the "
      "last state before it and the first one after it; no file without a jump.");
    table
      .add(
        [](const Jump &jump) -> std::string {
          return jump.is_pull_off()                                   ? "pull-off"
                 : jump.after.contact_area > jump.before.contact_area ? "closing"
                                                                      : "opening";
        },
        "kind: `closing` or `opening` by the change of the contact area, or `pull-off` "
        "if the surfaces part: no state follows, and gap and area after it are `nan`")
      .add([](const Jump &jump) { return jump.before.pressure; },
           "pressure_before [pressure]: nominal pressure before the jump")
      .add(
        [](const Jump &jump) { return jump.after.pressure; },
        "pressure_after [pressure]: nominal pressure after it; the load, or the mean "
        "gap if that is controlled, is at most `Load programme/Jump tolerance` away, or "
        "a warning says that some are farther")
      .add([](const Jump &jump) { return jump.before.mean_gap; },
           "mean_gap_before [length]: mean gap before the jump, as in leakage.csv")
      .add(after(&PathPoint::mean_gap), "mean_gap_after [length]: mean gap after it")
      .add([](const Jump &jump) { return jump.before.contact_area; },
           "contact_area_before [1]: contact area before it, as in leakage.csv")
      .add(after(&PathPoint::contact_area),
           "contact_area_after [1]: contact area after it")
      .add(&Jump::dissipated,
           "dissipated_energy [pressure length]: dissipated energy per area: what the "
           "change of the energy falls short of the reversible one, half the sum of mean "
           "gap × change of load at both ends, or of −pressure × change of mean gap if "
           "that is controlled; uncertain by half their difference, and `nan` for a "
           "pull-off");
    return table;
  }

  Table<RelaxationStep>
  relaxation_table(const Scene &scene, const std::string &step)
  {
    Table<RelaxationStep> table(
      "relaxation-" + step + ".csv",
      {"with `Contact/Adhesion/Trajectory`", scene.contact.adhesion.write_relaxation},
      "One row for each iteration at the last load of the step.");
    table.add(&RelaxationStep::iteration, "iteration [1]: number of the iteration")
      .add(&RelaxationStep::energy, "energy [pressure length]: energy per area")
      .add(&RelaxationStep::residual, "residual [1]: `contact_residual` of leakage.csv")
      .add(&RelaxationStep::step,
           "step [1]: length of the step along its direction; for GFMD the time step");
    return table;
  }

  Table<SpectrumRow>
  spectrum_table(const Scene &scene)
  {
    Table<SpectrumRow> table(
      "spectrum.csv",
      {"with `Output/Surface spectrum`", scene.output.surface_spectrum},
      "The power spectral density of the surface, one row for each "
      "ring of wave vectors.");
    table
      .add(&SpectrumRow::q,
           "wave_number [1/length]: wave number q of the ring, the geometric mean of its "
           "limits")
      .add([](const SpectrumRow &row) { return 2 * M_PI / row.q; },
           "wavelength [length]: 2π/q")
      .add(&SpectrumRow::density,
           "density [length⁴]: C(q) = \\|h~\\|² LxLy/(2π)², averaged over directions: "
           "∫d²q C = h_rms²")
      .add(&SpectrumRow::modes, "modes [1]: number of wave vectors in the ring")
      .add(&SpectrumRow::law,
           "fit [length⁴]: density by the self-affine law that fits best; `nan` beyond "
           "its range");
    return table;
  }
} // namespace strait
