// SPDX-License-Identifier: Apache-2.0
// A TCG plugin that counts instructions from one address to another.
//
// Arguments: out=<file> <name>=<hex address>-<hex address> ...
// Each pass of a span is a line "<name> <instructions>" of the file.
// Instructions count block by block, so a span is exact but for the blocks at its ends.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "sim/cosim/qemu_abi.h"

namespace touchdown {
namespace {

struct Span {
    std::string name;
    uint64_t first;
    uint64_t last;
    uint64_t began = 0;
    bool open = false;
};

std::vector<Span*> spans;
std::FILE* out = nullptr;
uint64_t instructions = 0;

void begin(unsigned, void* data) {
    Span& span = *static_cast<Span*>(data);
    span.began = instructions;
    span.open = true;
}

void end(unsigned, void* data) {
    Span& span = *static_cast<Span*>(data);
    if (!span.open) return;
    span.open = false;
    std::fprintf(out, "%s %llu\n", span.name.c_str(), static_cast<unsigned long long>(instructions - span.began));
    std::fflush(out);
}

void translate(uint64_t, void* block) {
    const size_t count = qemu_plugin_tb_n_insns(block);
    qemu_plugin_register_vcpu_tb_exec_inline(block, qemu::PLUGIN_INLINE_ADD, &instructions, count);
    for (size_t i = 0; i < count; ++i) {
        void* instruction = qemu_plugin_tb_get_insn(block, i);
        const uint64_t address = qemu_plugin_insn_vaddr(instruction);
        for (Span* span : spans) {
            if (address == span->first)
                qemu_plugin_register_vcpu_insn_exec_cb(instruction, begin, qemu::PLUGIN_NO_REGISTERS, span);
            if (address == span->last)
                qemu_plugin_register_vcpu_insn_exec_cb(instruction, end, qemu::PLUGIN_NO_REGISTERS, span);
        }
    }
}

int refuse(const char* sentence) {
    std::fprintf(stderr, "touchdown: %s\n", sentence);
    return 1;
}

}  // namespace
}  // namespace touchdown

extern "C" {
__attribute__((visibility("default"))) int qemu_plugin_version = qemu::PLUGIN_API;

__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const qemu::PluginInfo*, int count,
                                                               char** arguments) {
    using namespace touchdown;
    for (int i = 0; i < count; ++i) {
        const std::string argument = arguments[i];
        const size_t equals = argument.find('=');
        const size_t dash = argument.find('-', equals == std::string::npos ? 0 : equals);
        const std::string name = argument.substr(0, equals);
        if (name == "out" && equals != std::string::npos) {
            out = std::fopen(argument.c_str() + equals + 1, "w");
        } else if (equals != std::string::npos && dash != std::string::npos) {
            // QEMU keeps pointers to them as long as the process lives.
            spans.push_back(new Span{name, std::strtoull(argument.c_str() + equals + 1, nullptr, 16),
                                     std::strtoull(argument.c_str() + dash + 1, nullptr, 16)});
        } else {
            return refuse("an argument of the meter is neither out=file nor name=address-address.");
        }
    }
    if (out == nullptr) return refuse("the meter needs out= a file that can be written.");
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    return 0;
}
}
