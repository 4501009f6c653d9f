// SPDX-License-Identifier: Apache-2.0
// key=value arguments of the programs and of the plugin.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace touchdown {

class Arguments {
public:
    Arguments(int count, char** values) {
        for (int i = 0; i < count; ++i) {
            const std::string argument = values[i];
            const size_t equals = argument.find('=');
            if (equals != std::string::npos) table_[argument.substr(0, equals)] = argument.substr(equals + 1);
        }
    }

    const std::string& text(const std::string& key) const {
        const auto found = table_.find(key);
        if (found == table_.end()) throw std::runtime_error("the argument " + key + "= is missing.");
        return found->second;
    }

    uint64_t number(const std::string& key) const {
        const std::string& digits = text(key);
        if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos || digits.size() > 18)
            throw std::runtime_error("the argument " + key + "= takes a number and is '" + digits + "'.");
        return std::stoull(digits);
    }

private:
    std::map<std::string, std::string> table_;
};

}  // namespace touchdown
