#pragma once

#include <Teuchos_Array.hpp>
#include <string>
#include <vector>

#include "perimorph/input/mistakes.hpp"
#include "perimorph/input/resolved.hpp"

namespace perimorph::input {

/// The values of one section, if there are any and they are right by themselves, and where to say that they do not fit
/// together. Local.
class Values {
 public:
  /// Of the root. Both must outlive this.
  Values(const Resolved& resolved, Mistakes& mistakes) : Values(resolved, mistakes, resolved.list, "") {}

  /// A section in this one.
  Values sub(const std::string& name) const;

  /// The entries of a section in which the user names them.
  std::vector<Values> subs(const std::string& name) const;

  // Null if there is no value.
  const double* number(const std::string& name) const { return list_.getPtr<double>(name); }
  const int* count(const std::string& name) const { return list_.getPtr<int>(name); }
  const std::string* text(const std::string& name) const { return list_.getPtr<std::string>(name); }
  const Teuchos::Array<double>* numbers(const std::string& name) const {
    return list_.getPtr<Teuchos::Array<double>>(name);
  }
  const Teuchos::Array<std::string>* texts(const std::string& name) const {
    return list_.getPtr<Teuchos::Array<std::string>>(name);
  }

  /// A value as it would stand in a case file.
  std::string shown(const std::string& name) const;

  const std::string& path() const { return path_; }

  /// In the file or on the command line, be it right or not.
  bool given(const std::string& name) const { return resolved_.given(path_ + "/" + name); }

  void mistake(const std::string& name, const std::string& what) const;

 private:
  Values(const Resolved& resolved, Mistakes& mistakes, const Teuchos::ParameterList& list, std::string path)
      : resolved_(resolved), mistakes_(mistakes), list_(list), path_(std::move(path)) {}

  const Resolved& resolved_;
  Mistakes& mistakes_;
  const Teuchos::ParameterList& list_;
  std::string path_;
};

/// One number must exceed another.
void check_order(const Values& section, const std::string& smaller, const std::string& larger);

}  // namespace perimorph::input
