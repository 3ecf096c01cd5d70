// Every tolerance of core, in one place: its unit, why it has this value, and what worsens when it is moved.
// None changes while running. Relative ones are relative to the scene; absolute ones say which physics sets them.
#pragma once

#include <limits>

namespace tangent {

// ---- mesh ----

/// Ratio. A triangle whose smallest height is at most this part of its longest side has no area worth a name.
/// The cross product of the sides is rounded at 1e-16 of the longest side squared, so at this height the
/// normal still has four digits. Larger: real slivers vanish. Smaller: normals made of rounding noise.
inline constexpr double kDegenerateHeight = 1e-12;

/// Ratio to the largest coordinate of the triangle. A height below the rounding of the coordinates themselves is
/// no height, so that a triangle that is degenerate at the origin is also degenerate a kilometre away from it.
/// Larger: fine triangles far from the origin vanish. Smaller: collinear corners count as a sliver when moved.
inline constexpr double kCoordinateRounding = 2.0 * std::numeric_limits<double>::epsilon();

/// Metres. Coordinates beyond this count as not finite: their fourth powers (areas squared) stay well inside the
/// range of a double. Larger: overflow to infinity in squared areas. Smaller: nothing real is that large.
inline constexpr double kLargestCoordinate = 1e30;

/// Radians, added to --crease-deg: an edge at exactly the limit (an octagonal prism at 45 degrees) is no crease,
/// although its angle comes out rounded. Float coordinates turn a face by about 1e-7. Larger: the limit is not what
/// the user said. Smaller: equal edges of one prism are creases or not by chance.
inline constexpr double kCreaseSlack = 1e-6;

/// Ratio (radians for small angles). Corner normals this close are the same normal: text files print six digits.
/// A disagreement d opens the PN surface by about a third of d times the edge: 0.03 um on a 100 mm edge, far below
/// the solver's 1 um. Larger: visible cracks. Smaller: smooth edges become creases through printing.
inline constexpr double kSameNormal = 1e-6;

/// Ratio. A sum of weighted unit normals shorter than this part of its weights has cancelled: no direction is left.
/// Larger: thin fins lose their averaged normal. Smaller: the direction is rounding noise.
inline constexpr double kCancelledNormal = 1e-9;

/// Ratio to the area of a part of the mesh. Open in less than this it is still a body's surface, inside which a finger
/// that has lost its contact is not free: 0.04 of the Stanford bunny are holes. Larger: bowls count as bodies, and a
/// finger that has come under their rim is held for a moment; smaller: in scans with holes fingers fall through.
inline constexpr double kHoleShare = 0.1;

/// Ratio, audit only. A triangle whose smallest height is below this part of its longest side is listed as a sliver.
/// Nothing is skipped by it. Larger: ordinary long triangles are listed. Smaller: troublesome ones are not.
inline constexpr double kSliverAspect = 1e-2;

/// Degrees, audit only. A corner normal further than this from its face's normal is listed as wild: PN triangles fold
/// near 90 degrees. Larger: patches that bulge wildly pass. Smaller: honest normals of coarse meshes are listed.
inline constexpr double kWildNormalDeg = 60.0;

// --- Solver -------------------------------------------------------------------------------------------

/// det M below which `robust` does not trust a Newton step, 1. Newton's step grows as 1/det, and is limited by the
/// travel (below). Larger: tangent steps where Newton is fine, which leave 1 - det of the error where it is small, so
/// that a search gives up on a sound contact; smaller: wild steps near a fold.
inline constexpr double kNewtonMinDet = 0.01;

/// Longest step of `robust`, in travels, 1, where it is no short one: below kShortStep of the triangle in both
/// parameters. A convex point contact needs at most 1/(1 + h k); only ground near a fold asks for more. Larger: leaps
/// to other places; smaller: slow approach in concave ground, by a part of the way each plane.
inline constexpr double kLongestStepPerTravel = 4.0, kShortStep = 0.05;

/// Ratio. An edge whose curve leaves its chord by less than this part of its length, between normals that turn by less
/// than this (rad), is straight: its fan of normals is the same all along and computed once; a patch that leaves its
/// triangle by no more is flat. Rounding leaves 1e-16. Larger: contacts on all but straight edges are off by that part
/// of the edge; smaller: flat sides turned in space are missed.
inline constexpr double kStraightEdge = 1e-13;

/// New planes `robust` spends on following the kept contact before it seeds anew, 1. More: a stale contact
/// costs longer before it is given up; fewer: slow but sound convergence is thrown away.
inline constexpr int kTrackBudget = 8;

/// New planes a seed of `robust` may spend, 1.
inline constexpr int kSeedBudget = 16;

/// Triangles that one step may cross, 1: beyond, it is no step of an iteration any more and the contact counts as lost.
/// Of `robust` where it follows the kept contact fewer: after a leap no cache holds the triangles on the way. With 256
/// there, too, the 99th percentile of ticks at random places on 5 million triangles of an 80 mm sphere was 276 to 381
/// us, with 64 it is 135 to 175
/// (`bench --suite scale --ticks 1000`). At 1 m/s a finger crosses 24 of those triangles a tick.
inline constexpr int kMostCrossings = 256;
inline constexpr int kMostTrackedCrossings = 64;

/// The same of searches for rivals, and of that for a start of a finger that is not round once one is touched: along
/// the flank of a long finger steps run from end to end, and one that far from its triangle says nothing of it. More:
/// the 99th percentile of a capsule of 8 mm with half a length of 10 on the bunny is 1.5 ms (64) instead of 0.53, and
/// on rough ground a solve of 14 planes under a ball takes up to 78 us; fewer: rivals across fine triangles are asked
/// again.
inline constexpr int kMostRivalCrossings = 16;

/// New planes that a suspected rival costs before its height tells whether it is worth more, and those that it may cost
/// then, 1; both twice on creases and boundaries. Its place is known to 1/30 of a triangle, where Newton mostly needs
/// one or two, near a fold more. Fewer: deeper places beside a fold are taken for none; more: rivals that are none cost
/// planes at every tick.
inline constexpr int kRivalBudget = 2, kDeeperRivalBudget = 5;

/// Nearest triangles that seed a contact where the hierarchy finds none, 1: the nearest triangle's patch often holds
/// none itself. More: slower re-seeding; fewer: contacts missed in rough ground.
inline constexpr int kSeeds = 24;

/// Contacts solved in one search of the hierarchy, 1. At the centre of a sphere every triangle holds one. More: the
/// worst tick takes longer; fewer: a deeper place may be missed in such degenerate poses.
inline constexpr int kMaxSolves = 256;

/// A normal that turns by over 10 degrees in a tick has jumped (cosine, 1). Larger angle: jumps pass unnoticed;
/// smaller: fast turns on small radii count as jumps.
inline constexpr double kJumpCosine = 0.984807753012208;

// The next three are in switch hystereses (20 um unless the preset says otherwise), so that they go with the scene's
// size.

/// By this much the depth of a contact may change in a tick beside what the finger's motion explains: 25 um, 0.02 N at
/// 800 N/m, the force that a fade lets through in a millisecond. Larger: leaps pass unmarked; smaller: rounding is
/// marked.
inline constexpr double kLeapDepth = 1.25;

/// By this much a place may be deeper than the tracked one was, beside the finger's motion and the hysteresis itself,
/// when it is first found: 100 um, what a search may have come late by. Deeper ones were never entered from outside:
/// the finger has come by behind them. Larger: sheets push from behind; smaller: an honest switch is refused.
inline constexpr double kEnteredDepth = 5.0;

/// Way of a search that is late up to which a place may have been entered meanwhile, 1 mm. Larger: what is behind a
/// rough sheet pushes after a long search; smaller: a place that was entered in front of a fast finger does not.
inline constexpr double kMostLateEntry = 50.0;

/// Seconds for which a finger that was pressed into a closed body, and whose contact was lost, counts as still inside
/// however the surface looks from there: the force has faded by then. Longer: one that has left without being noticed
/// is searched for longer; shorter: one that is inside sinks.
inline constexpr double kInsideFor = 0.1;

/// A finger that goes further in one tick, 5 mm, has been put elsewhere, and what it is in counts as entered.
inline constexpr double kLeapOfFinger = 250.0;

/// Where the force comes from every place that is touched, which of them is the tracked one only matters to the
/// display: another takes over when it is deeper by this, 100 um, above a hand's tremor of 50. Larger: the display
/// shows the shallower place; smaller: it goes to and fro. And a place is forgotten when the finger has left it by as
/// much. Larger: more places are followed in vain; smaller: a trembling finger loses and finds them, each time by a
/// search.
inline constexpr double kTremor = 5.0, kLeftTouch = 5.0;

/// Switch hystereses, 2 mm: of a finger that is not round and touches nothing, places count that are nearer than this,
/// and others only where it has none. At 0.1 m/s it is there after 20 ms. Larger: dear searches for what is not
/// touched; smaller: the display begins later to go to the place that will be.
inline constexpr double kSoonTouched = 100.0;

/// Ticks, at the finger's present speed, that the search for deeper places looks ahead, and where the last ones were
/// dear (Clearance::ahead). More: fewer, larger searches. On the bunny under a 20 mm finger the mean is all but the
/// same from 3 to 8, the 99.9th percentile a third higher with 8.
inline constexpr double kWatchTicks = 8.0, kDearTicks = 4.0;

/// Ticks, at that speed, and part of the contact's height, that ground which is not steady is taken for a known
/// contact's slope. Larger: proofs of slopes hold in fewer triangles; smaller: searches look at them again and again.
inline constexpr double kSlopeTicks = 12.0, kLargestSlope = 0.3;

/// The look-ahead is a ball whose middle lies this part of it ahead of the finger, in the direction in which it moves,
/// at most so many ticks. Larger: a finger that turns round has soon left it; smaller: the ball for the same way is
/// larger.
inline constexpr double kLead = 0.43, kLeadTicks = 12.0;

/// Least and largest look-ahead, as a part of the contact's height: at rest still 40 um for a finger of 20 mm, wider
/// than a hand at rest trembles. Larger: searches over more triangles; smaller: a trembling finger leaves the ball
/// again and again.
inline constexpr double kSmallestWatch = 2e-3, kLargestWatch = 0.1;

/// Switch hystereses (base/tolerances.h above) that a search looks ahead at least, 1.2 mm, times Clearance::ahead:
/// doubled, up to kMostAhead, by a search that looks at kCheapLooks triangles at most and finds nothing to watch,
/// halved, down to kLeastAhead, by one that looks at more than kDearLooks. Such a search halves what is left of its own
/// look-ahead, too, after every kDearLooks, down to kDearTicks. Larger: dear searches on rough ground; smaller:
/// frequent ones on smooth ground.
inline constexpr double kWatchReach = 60.0;
inline constexpr float kLeastAhead = 0.0625f, kMostAhead = 8.0f;
inline constexpr int kCheapLooks = 12, kDearLooks = 48;

/// Part of the way for which slopes hold that remains where a triangle could neither be ruled out nor be solved: half a
/// tick. A contact comes up there at once where the offset surface unfolds. Larger: it takes over late; smaller:
/// nothing, the next tick looks anyway.
inline constexpr double kUnresolvedMargin = 0.5 / kSlopeTicks;

/// Solver tolerances. Contacts nearer to each other than this are the same one. Larger: places that merge are one too
/// soon; smaller: one place solved for twice counts twice.
inline constexpr double kMergedPlaces = 10.0;

/// Contacts whose surroundings one search for rivals remembers, 1.
inline constexpr std::size_t kKnownContacts = 8;

/// Ratio to the coordinates of finger and triangle (metres of either, summed): what rounding may add to the margin of a
/// proof that a triangle holds no contact. Larger: contacts near a border are looked at by both triangles, which costs
/// a proof; smaller: one exactly on a border or a corner is excluded by all triangles around it.
inline constexpr double kProofRounding = 1e-14;

/// Bisections of a patch in search of a contact, and parts looked at in all; where it holds one, Newton's steps find it
/// before. More: near a fold fewer false alarms, each of which costs a few surface evaluations; fewer: cheaper beside a
/// fold (6: 6 % of fandisk's ticks without creases, and one of 1,152,000 ticks on random ground behind a deeper place).
inline constexpr int kBisections = 8, kBisectionTests = 48;

/// Part of its height by which a rival's height is guessed wrong at most, without solving for it. Larger: rivals are
/// solved for before they can take over; smaller: a takeover may come a tick late.
inline constexpr double kHeightGuess = 1e-4;

/// det M below which a rival is solved for all the same: it may be the unstable one of two that met at a fold. Larger:
/// more rivals are solved for; smaller: the wrong one of the two is watched, and the other takes over late.
inline constexpr double kGuessMinDet = 0.2;

/// Part of the way to a takeover, as first and second order tell it, that is gone before a rival is looked at again.
/// Larger: near a fold, where heights bend by more than that, it comes a tick late; smaller: rivals are looked at more
/// often.
inline constexpr double kOvertakingRoom = 0.5;

/// A suspected rival as near to the tracked contact as this part of a triangle's side, and as high within kHeightGuess,
/// is the tracked contact itself. Larger: a true rival as near and as deep goes unnoticed, which nobody feels; smaller:
/// the tracked contact is solved for again wherever it comes near the side of a triangle.
inline constexpr double kSamePlace = 0.0625;

/// Part of the raw mesh's distance by which a seeded contact may lie further off before more seeds are tried.
inline constexpr double kImplausibleShare = 0.02;

/// 1 + h k keeps this far from 0 on the slope that leads to a contact, less 1: h k, the curvature times the height, is
/// above -kFoldRoom. Larger: folds within a triangle hide deeper contacts; smaller: hollow ground near the contact is
/// searched.
inline constexpr double kFoldRoom = 0.1;

/// Ground is steady, its contacts come and go over its border only, where 1 + h k stays above this at all heights h
/// that are asked for. Contacts move there by at most the finger's way over the room that is left (below). Larger: more
/// ground is searched with a margin; smaller: contacts near a fold outrun the ticks.
inline constexpr double kSteadyRoom = 0.2;

/// Squared sine of the angle between N and the surface's own normal on steady ground at most, 17 degrees. Larger: takes
/// more of the room; smaller: fewer patches of coarse meshes count.
inline constexpr double kSteadyLean = 0.09;

/// Around a contact, its own slope reaches this many look-aheads and a triangle far, as a ratio. Larger: places behind
/// a fold are taken for the slope's; smaller: searches over the triangles that the contact walks to anyway.
inline constexpr double kBasinReach = 0.25;

/// The same where normals agree this well (8 degrees): gently curved ground, on which the slope reaches further.
inline constexpr double kGentleCosine = 0.99, kGentleReach = 1.5;

/// Cosine of the angle by which normals may differ from the contact's on its own slope.
inline constexpr double kBasinCosine = 0.9;

// --- Rendering ----------------------------------------------------------------------------------------

/// N/s: by this much the force may change without the finger's moving. A tenth of a newton takes 5 ms, the peak of a
/// Premium 0.4 s. Larger: a switch of contacts is felt as a knock; smaller: the surface seems to give way after one.
inline constexpr double kForceFade = 20.0;

/// Seconds in which the rate at which a change of preset or scene is faded in doubles, and so on, linearly: out of a
/// stiff surface a finger is let at kForceFade over stiffness, 6 mm/s, and one that slides quickly over tight curves
/// would never get the force decided for it. Larger: both take longer; smaller: a deep finger is let out faster.
inline constexpr double kChangeFade = 1.0;

/// Travels of the display a second, 1/s, likewise: 0.26 m/s for 16 mm, about what its spindle can do. Larger: a leap of
/// the contact is felt as a click; smaller: the display lags behind a finger that turns quickly.
inline constexpr double kDisplayFade = 16.0;

/// Seconds that a display stays where it is after the contact has switched to another place: a tremor between two walls
/// switches every few ticks, and a display that followed each would rattle. Larger: it comes late; smaller: it rattles.
inline constexpr double kDisplayWait = 0.05;

/// Least part of a contact's direction that lies in the finger's section, 1: at less, within 15 degrees of the finger's
/// sides, the place along the finger is left as it was. Larger: the display holds where it could still show something;
/// smaller: it races from end to end as the contact passes the side.
inline constexpr double kPadSection = 0.2588;

}  // namespace tangent
