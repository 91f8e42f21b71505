#pragma once

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"
#include "perimorph/io/checkpoint.hpp"

// What is in a checkpoint is described once, by functions that take a DataSetWriter or a DataSetReader: the first puts
// values into data sets by name, the second takes them out in the same order.

namespace perimorph::output {

/// Small data sets, whole; on rank 0. Local.
class DataSetWriter {
 public:
  explicit DataSetWriter(io::Checkpoint& checkpoint) : checkpoint_(checkpoint) {}

  template <class... Value>
  void numbers(const char* name, const Value&... values) {
    checkpoint_.numbers[name] = {static_cast<double>(values)...};
  }
  template <class... Value>
  void integers(const char* name, const Value&... values) {
    checkpoint_.integers[name] = {static_cast<base::GlobalId>(values)...};
  }
  void list(const char* name, const std::vector<double>& values) { checkpoint_.numbers[name] = values; }
  void list(const char* name, const std::vector<base::GlobalId>& values) { checkpoint_.integers[name] = values; }

  /// Members of each record, one record after the other.
  template <class Record, class... Member>
  void records(const char* name, const std::vector<Record>& records, Member... members) {
    auto& values = checkpoint_.integers[name];
    for (const auto& record : records) (values.push_back(record.*members), ...);
  }
  /// An array of numbers in each record, one after the other.
  template <class Record, class Array>
  void arrays(const char* name, const std::vector<Record>& records, Array Record::*member) {
    auto& values = checkpoint_.numbers[name];
    for (const auto& record : records) values.insert(values.end(), (record.*member).begin(), (record.*member).end());
  }
  /// A text in each record; no text holds a zero.
  template <class Record>
  void texts(const char* name, const std::vector<Record>& records, std::string Record::*member) {
    auto& all = checkpoint_.texts[name];
    for (const auto& record : records) all += record.*member + '\0';
  }

 private:
  io::Checkpoint& checkpoint_;
};

/// Small data sets go from rank 0 to all ranks: every call is collective.
class DataSetReader {
 public:
  DataSetReader(const base::Comm& comm, const io::Checkpoint& checkpoint) : comm_(comm), checkpoint_(checkpoint) {}

  template <class... Value>
  void numbers(const char* name, Value&... values) {
    const auto all = of_rank_0(checkpoint_.numbers, name);
    std::size_t i = 0;
    ((values = static_cast<Value>(all.at(i++))), ...);
  }
  template <class... Value>
  void integers(const char* name, Value&... values) {
    const auto all = of_rank_0(checkpoint_.integers, name);
    std::size_t i = 0;
    ((values = static_cast<Value>(all.at(i++))), ...);
  }
  void list(const char* name, std::vector<double>& values) { values = of_rank_0(checkpoint_.numbers, name); }
  void list(const char* name, std::vector<base::GlobalId>& values) { values = of_rank_0(checkpoint_.integers, name); }

  template <class Record, class... Member>
  void records(const char* name, std::vector<Record>& records, Member... members) {
    const auto all = of_rank_0(checkpoint_.integers, name);
    PERIMORPH_ASSERT(all.size() % sizeof...(members) == 0, "{}: {} values, {} a record", name, all.size(),
                     sizeof...(members));
    records.resize(all.size() / sizeof...(members));
    auto value = all.begin();
    for (auto& record : records) ((record.*members = *value++), ...);
  }
  /// Of records that are there already.
  template <class Record, class Array>
  void arrays(const char* name, std::vector<Record>& records, Array Record::*member) {
    const auto all = of_rank_0(checkpoint_.numbers, name);
    auto value = all.begin();
    for (auto& record : records) {
      for (auto& number : record.*member) number = *value++;
    }
  }
  template <class Record>
  void texts(const char* name, std::vector<Record>& records, std::string Record::*member) {
    std::istringstream all(base::broadcast(comm_, comm_.getRank() == 0 ? checkpoint_.texts.at(name) : ""));
    for (auto& record : records) std::getline(all, record.*member, '\0');
  }

 private:
  const base::Comm& comm_;
  const io::Checkpoint& checkpoint_;

  template <class Map>
  typename Map::mapped_type of_rank_0(const Map& sets, const char* name) const {
    using Values = typename Map::mapped_type;
    return base::gather_on_all(comm_, comm_.getRank() == 0 ? sets.at(name) : Values());
  }
};

/// Large data sets, of which each rank has some rows: a row for each of its records. Local, on all ranks.
class RowWriter {
 public:
  explicit RowWriter(io::Checkpoint& checkpoint) : checkpoint_(checkpoint) {}

  /// Members of each record.
  template <class Record, class... Member>
  void records(const char* name, const std::vector<Record>& records, Member... members) {
    auto& rows = checkpoint_.integer_rows[name] = {sizeof...(members), {}};
    for (const auto& record : records) (rows.values.push_back(record.*members), ...);
  }
  /// An array of numbers in each record.
  template <class Record, class Array>
  void arrays(const char* name, const std::vector<Record>& records, Array Record::*member) {
    auto& rows = checkpoint_.number_rows[name] = {std::tuple_size_v<Array>, {}};
    for (const auto& record : records) {
      rows.values.insert(rows.values.end(), (record.*member).begin(), (record.*member).end());
    }
  }

 private:
  io::Checkpoint& checkpoint_;
};

/// The rows that this rank has. Local.
class RowReader {
 public:
  explicit RowReader(const io::Checkpoint& checkpoint) : checkpoint_(checkpoint) {}

  template <class Record, class... Member>
  void records(const char* name, std::vector<Record>& records, Member... members) {
    const auto& rows = checkpoint_.integer_rows.at(name);
    PERIMORPH_ASSERT(rows.width == sizeof...(members), "{}: {} values in a row", name, rows.width);
    records.resize(rows.n_rows());
    auto value = rows.values.begin();
    for (auto& record : records) ((record.*members = *value++), ...);
  }
  /// Of records that are there already.
  template <class Record, class Array>
  void arrays(const char* name, std::vector<Record>& records, Array Record::*member) {
    const auto& rows = checkpoint_.number_rows.at(name);
    PERIMORPH_ASSERT(rows.values.size() == records.size() * std::tuple_size_v<Array>, "{}: {} values of {} records",
                     name, rows.values.size(), records.size());
    auto value = rows.values.begin();
    for (auto& record : records) {
      for (auto& number : record.*member) number = *value++;
    }
  }

 private:
  const io::Checkpoint& checkpoint_;
};

}  // namespace perimorph::output
