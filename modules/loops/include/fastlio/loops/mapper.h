// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mapper.h Submaps in, loops closed: the poses that all measurements together make most
 * likely. */
#pragma once

#include <fastlio/posegraph/odometry_chain.h>
#include <fastlio/posegraph/pose_graph.h>
#include <fastlio/submaps/place_recognition.h>
#include <fastlio/submaps/registration.h>
#include <fastlio/submaps/submap.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** What became of a possible closure. */
enum class ClosureVerdict
{
  Accepted,
  FewPlanes,      //!< too little to compare
  Unpredicted,    //!< the odometry is lost: any place that looks the same could be meant
  LittleOverlap,  //!< the submaps do not show the same surfaces
  PoorFit,        //!< the surfaces do not agree
  Ambiguous,      //!< another place fits nearly as well
  OutOfReach,     //!< the odometry excludes it
  Uninformative,  //!< it leaves a direction open
  Contradicted    //!< the other measurements exclude it
};

/** "accepted", "few_planes", ... */
[[nodiscard]] const char* toString(ClosureVerdict verdict);

/** Two submaps that may show the same place. */
struct Closure
{
  std::size_t a = 0, b = 0;   //!< numbers of the submaps, a the earlier one
  RelativePose predicted;     //!< T_a_b before the registration
  Registration registration;  //!< T_a_b
  ClosureVerdict verdict = ClosureVerdict::FewPlanes;
  std::string reason;            //!< the verdict with its numbers, for people
  bool needs_agreement = false;  //!< of another closure: nothing else is missing
};

/** What a registration has to show. */
struct ClosureLimits
{
  double distance = 10.0;         //!< between submaps that are compared [m]
  double least_travel = 25.0;     //!< between them, within a run [m]
  std::size_t candidates = 3;     //!< that a submap is compared with at most
  std::size_t min_planes = 60;    //!< of each submap
  double min_overlap = 0.4;       //!< RegistrationEvidence::overlap
  double min_upright = 0.4;       //!< RegistrationEvidence::upright_score
  double min_inlier_ratio = 0.6;  //!< RegistrationEvidence::inlier_ratio
  double max_residual = 0.06;     //!< RegistrationEvidence::residual_rms [m]
  double min_margin = 25.0;       //!< RegistrationEvidence::margin
  /** Of a closure, in its least known direction [m]: doors and pillars that are alike pull a
   * registration along a corridor by more than it knows of. */
  double max_position_std = 0.1;
  /** RegistrationEvidence::planes_across, in this direction: in a stairwell, the noise of its walls
   * seems to tell the height. Neighbouring planes share errors: so many count as one. */
  double min_planes_across = 8.0;
  /** Least known directions of the position that are exempt from both: along a corridor, a closure
   * may determine the rest. */
  int open_directions = 0;
  /** From the prediction, in its standard deviations. What repeats fits perfectly where the
   * odometry is worst, on another floor for example: nothing else than its distance tells it
   * apart. */
  double max_deviation = 5.0;
  /** In narrow places, the next one that looks the same may be this far, as a part of the median
   * range of the submaps: rooms and doors repeat at about the size of what is seen of them. */
  double alike_over_range = 1.5;
  double least_storey = 3.0;  //!< the same for heights, below ceilings: the next floor [m]
  /** In narrow places, instead of max_deviation: what looks the same has to be beyond it. */
  double narrow_deviation = 4.0;
  /** Where the odometry knows the place this well [m], it excludes places that look alike. Then
   * fewer surfaces suffice, and the closure may leave one direction open. Where the place is not
   * narrow, it may be known to maxStd() only: what looks the same along a street is one place then,
   * or fewer upright surfaces suffice, as leaves and trunks are other planes in each pass. Where it
   * is, the height may stay open if only the place on the floor is known this well. */
  double known_place_std = 0.25;
  double known_place_overlap = 0.15;  //!< instead of min_overlap and min_upright

  /** How uncertain a place may be where so much is in view [m]. */
  [[nodiscard]] double maxStd(double range) const
  {
    return alike_over_range / narrow_deviation * range;
  }
};

/** How a session was found in the map of those before. */
struct SessionAnchor
{
  bool found = false;
  Pose T_world_session;      //!< takes poses of the session's odometry to the map
  double probability = 0.0;  //!< that it is right, by the margins of what supports it
  std::size_t tried = 0;     //!< submaps that were looked up
  std::size_t support = 0;   //!< of them, those that say so, each on its own
};

/** The outcome. */
struct MappingResult
{
  std::vector<Submap> submaps;         //!< of the sessions that were found in the map
  std::vector<SessionAnchor> anchors;  //!< of each session
  std::vector<Closure> closures;       //!< all that were looked at
  PoseGraph graph;                     //!< with the accepted closures
  GraphEstimate estimate;
  bool corrected = false;  //!< false: nothing was added to what the odometry knows
  /** A number for the rig of each session; empty: nobody knows them, and each session counts as one
   * of another rig. */
  std::vector<std::size_t> rigs;

  [[nodiscard]] std::size_t countOf(ClosureVerdict verdict) const;
  [[nodiscard]] std::size_t accepted() const { return countOf(ClosureVerdict::Accepted); }
  /** Whether poses of a session are not those of its odometry: something corrects them, or the
   * session was placed in the map of those before. */
  [[nodiscard]] bool moves(std::size_t session) const;
  /** Whether two sessions are known to have the same errors of the pose of the LiDAR. */
  [[nodiscard]] bool areOneRig(std::size_t session, std::size_t other) const;
};

/** Turns a result about its first node so that the estimated vertical is z. Covariances are
 * relative to the first node and turn with it. */
void makeLevel(MappingResult& result);

/** Finds loops while submaps come in. Not thread-safe. The result depends on the submaps and their
 * order alone. */
class Mapper
{
 public:
  /** \param workers who share the work; the result does not depend on them */
  explicit Mapper(
      ClosureLimits limits = {},
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1))
      : limits_(limits), workers_(std::move(workers))
  {
  }

  /** Adds the next submap of a run and looks for places that it has in common with earlier ones.
   * Sessions come one after the other. Where one is in the map of those before has to be found
   * first: two of its submaps have to be recognised, each on its own, at places that agree. */
  void add(Submap submap);

  /** The optimum of everything, from the odometry on. It does not depend on earlier calls, and
   * submaps may follow. */
  [[nodiscard]] MappingResult result() const&;
  /** The same without a copy of the submaps, in the end. */
  [[nodiscard]] MappingResult result() &&;

  [[nodiscard]] const std::vector<Submap>& submaps() const { return result_.submaps; }
  [[nodiscard]] const std::vector<Closure>& closures() const { return result_.closures; }
  /** Accepted closures so far. */
  [[nodiscard]] std::size_t accepted() const { return result_.accepted(); }

 private:
  /** What is around two submaps. */
  struct Surroundings
  {
    Vec3 up = Vec3::UnitZ();  //!< against gravity, in the frame of the earlier one
    double range = 0.0;       //!< median, the smaller one [m]
    bool below_ceiling = false;

    /** Stairwells, corridors and rooms, not streets. */
    [[nodiscard]] bool isNarrow() const
    {
      constexpr double kNarrow = 5.0;  // [m]
      return below_ceiling || range < kNarrow;
    }
  };

  /** Where a session may be in the map, by one of its submaps. */
  struct Hypothesis
  {
    Pose T_world_session;
    double margin = 0.0;
    std::size_t submap = 0;  //!< of the session
  };

  void join(Submap submap);
  void searchAnchor();
  [[nodiscard]] std::optional<Hypothesis> recognised(const Submap& query) const;
  void addOdometry();
  void addEdge(const Closure& closure);
  void beginSession(const Submap& first, std::size_t b);
  [[nodiscard]] std::vector<std::size_t> candidatesOf(std::size_t b) const;
  [[nodiscard]] RelativePose predictedMotion(std::size_t a, std::size_t b) const;
  [[nodiscard]] std::optional<RelativePose> odometryMotion(std::size_t a, std::size_t b) const;
  [[nodiscard]] Closure compared(std::size_t a, std::size_t b) const;
  void judge(Closure& closure, const ClosureLimits& limits, const std::optional<Vec3>& open) const;
  void judgePrediction(Closure& closure, const Surroundings& around) const;
  [[nodiscard]] RelativePose motionBetween(std::size_t a, std::size_t b) const;
  [[nodiscard]] std::optional<bool> closuresAgree(const Closure& one, const Closure& other) const;
  void acceptAgreeing(const Closure& latest);
  [[nodiscard]] bool isFloorKnown(const RelativePose& predicted, const Vec3& up) const;
  [[nodiscard]] ClosureLimits limitsFor(
      const Closure& closure, const Surroundings& around, const std::optional<Vec3>& weak) const;
  void settle();

  ClosureLimits limits_;
  std::shared_ptr<const Workers> workers_;
  MappingResult result_;
  std::vector<Pose> poses_;             //!< present estimate of the submaps
  std::vector<Matrix6> covariances_;    //!< of them
  std::vector<Submap> floating_;        //!< of a session that was not found yet
  std::vector<Hypothesis> hypotheses_;  //!< where it may be
  std::unique_ptr<PlaceIndex> places_;  //!< of the sessions before
  std::size_t settled_submaps_ = 0;     //!< when the graph was optimised last
  OdometryChain chain_;                 //!< to the latest submap
};

}  // namespace fastlio
