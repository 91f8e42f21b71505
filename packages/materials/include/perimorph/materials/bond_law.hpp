#pragma once

#include <algorithm>
#include <limits>

namespace perimorph::materials {

/// How the force of a bond falls from its limit: at once, in two straight lines, or as an exponential function.
enum class Softening { none, bilinear, exponential };

/// What compression across a brittle bond does to its breaking. Of a bond's stretch s = (sigma - nu sigma_across) / E
/// the part -nu sigma_across / E comes from the sum of the stresses across it; where these compress, a share of that
/// part does not count (DECISIONS.md, 43).
struct LateralCompression {
  double uncounted = 0.;       ///< that share, 0 ... 1 [-]
  double per_dilatation = 0.;  ///< nu sigma_across / E = per_dilatation theta - per_stretch s: lambda / E, [-]
  double per_stretch = 0.;     ///< nu / (1 + nu), [-]
};

/// The force of a bond over its stretch s, in units of its stiffness: s up to the limit s0, beyond it s0 phi(s), with
/// phi falling from 1 to nothing at the critical stretch s_c, where the bond breaks; a brittle one does so at its
/// limit. Bilinear (Petersson 1981): phi is linear through (s0, 1), (s1, 1/3) and (s_c, 0) with
/// (s1 - s0)/(s_c - s0) = 0.8/3.6. Exponential: phi = exp(-(s - s0)/s_f), broken where a thousandth is left. Unloading
/// goes straight to the origin, with the share of the stiffness that the largest stretch so far has left. All stretches
/// and shares are in [-].
class BondLaw {
 public:
  /// Brittle; of an infinite stretch unbreakable.
  /// @param critical_stretch >= 0
  BondLaw(double critical_stretch = std::numeric_limits<double>::infinity());  // NOLINT(google-explicit-constructor)

  /// @param softening not none
  /// @param limit s0 > 0
  /// @param area under the force, in units of the stiffness, [-]: above s0^2/2, which a brittle bond has
  static BondLaw softening(Softening softening, double limit, double area);

  Softening softening() const { return softening_; }
  bool softens() const { return softening_ != Softening::none; }
  double limit() const { return limit_; }
  double critical_stretch() const { return critical_; }

  /// Share of the stiffness that is left after a largest stretch, 1 - D.
  double share_left(double largest_stretch) const;

  /// What has been dissipated by a largest stretch, in units of the stiffness: the integral of s^2/2 over D.
  double dissipation(double largest_stretch) const;

  /// Area under the force: what all of it dissipates, in units of the stiffness.
  double area() const { return area_up_to(critical_); }

  /// The same law for bonds that compression across them lets stretch further. @param compression of a brittle law
  BondLaw under(const LateralCompression& compression) const;
  bool sees_compression() const { return compression_.uncounted > 0.; }

  /// What counts of a stretch, and reaches the critical one where the bond breaks: at most the stretch itself.
  /// @param dilatation theta, the mean of the bond's ends, [-]
  double counted_stretch(double stretch, double dilatation) const {
    const double by_compression = compression_.per_dilatation * dilatation - compression_.per_stretch * stretch;
    return stretch + compression_.uncounted * std::min(0., by_compression);
  }

  /// All of its stretches times a factor > 0, and so its area times the square of that.
  BondLaw scaled(double factor) const;

 private:
  Softening softening_ = Softening::none;
  double limit_, critical_;
  LateralCompression compression_;

  double share_of_limit(double stretch) const;
  double area_up_to(double stretch) const;
};

}  // namespace perimorph::materials
