// The lines take seconds at most: small scenarios, few runs.
#include "checker/cli/examples.hpp"

#include <array>

#include <fmt/core.h>

namespace stormproof::cli {

namespace {

struct OfCommand {
  std::string_view command;
  std::array<Example, 3> examples;  ///< fewer: the last are empty
};

constexpr OfCommand all_examples[] = {
    {"init",
     {{{"stormproof init --hosts 4 --participants 2 --endpoints 25 --ros jazzy -o fleet.yaml",
        "a first scenario of your own robots"},
       {"stormproof init specs/captures/fastdds291_ap_np3_ne10_r0.pcap.xz",
        "of whoever took part in a capture"}}}},
    {"simulate",
     {{{"stormproof simulate wifi-5x20-fastdds",
        "when discovery completes, and what fills the channel until then"},
       {"stormproof simulate live-5x20 --samples 12 --compare jazzy",
        "how far runs with other start times spread, and what another version does"},
       {"stormproof simulate smallest --set dds=humble --set wireless=mesh-3-hops",
        "a shipped scenario with another DDS profile and another network"}}}},
    {"check",
     {{{"stormproof check smallest", "every property, with counterexamples of what is violated"},
       {"stormproof check wired-5x20 --property live.completion", "one property"},
       {"stormproof check smallest --property storm.single-copy --format junit",
        "for a CI system"}}}},
    {"fix",
     {{{"stormproof fix fleet-4x2x20 --time 60s",
        "settings, ways to discover, launch plans: what cures it?"},
       {"stormproof fix fleet-4x2x20 --keep vendor --keep settings --export fix",
        "without touching these, and the files to deploy"}}}},
    {"diff",
     {{{"stormproof diff humble jazzy --over smallest --no-check --no-telling-apart",
        "what another version does to one deployment"},
       {"stormproof diff specs/vendor/fastdds/humble-default.xml "
        "specs/vendor/fastdds/large-send-buffer.xml --over three-hosts --no-check",
        "two files of a vendor, and the smallest scenario that tells them apart"},
       {"stormproof diff --exhibit E7 paper --over smallest --no-telling-apart",
        "does a defect of the museum reach this deployment?"}}}},
    {"compare-discovery",
     {{{"stormproof compare-discovery smallest --set dds=humble --start-jitter 20ms --samples 3",
        "Discovery Server, static peers, Cyclone: which is best here, and how far does each go?"},
       {"stormproof compare-discovery smallest --set dds=humble --sizes 3 --export ways",
        "and the files to deploy each of them"}}}},
    {"launch",
     {{{"stormproof launch fleet-4x2x20 --samples 3 --step 100ms --step 400ms",
        "all at once, one after the other, in waves: how soon does everybody know everybody?"},
       {"stormproof launch three-hosts --set dds=humble --join --export launch",
        "and what a robot runs for it, and what one more robot costs"}}}},
    {"survive",
     {{{"stormproof survive live-5x20 --samples 2 --length 1s --length 30s",
        "the network, a host, a process is away: who recovers, and how soon?"},
       {"stormproof survive live-5x20 --set dds=fastdds-server-2.6.11 --length 5s --samples 2",
        "and with a Discovery Server, which may be killed, too?"}}}},
    {"fuzz",
     {{{"stormproof fuzz smallest --runs 20 --loss 2%", "does it hold when packets are lost?"},
       {"stormproof fuzz three-hosts --runs 10 --limit completion=60s --start-jitter 100ms",
        "is it always complete after a minute, whoever starts first?"}}}},
    {"sensitivity",
     {{{"stormproof sensitivity smallest", "every number of the scenario, 20 % down and up"},
       {"stormproof sensitivity smallest --by messages --start-jitter 10ms --samples 3",
        "what decides how much is sent, in samples"}}}},
    {"sweep",
     {{{"stormproof sweep small -o runs.db", "all scenarios of a grid; again goes on"},
       {"stormproof sweep small -o runs.db --csv runs.csv", "and the results as a table"}}}},
    {"tune",
     {{{"stormproof tune smallest --preset humble --budget 50 --samples 6",
        "the best settings that a user of this version can make"},
       {"stormproof tune smallest --preset humble --budget 50 --samples 6 -o tuned",
        "and as XML files to deploy"}}}},
    {"reproduce",
     {{{"stormproof reproduce paper --profile paper --samples 1",
        "the paper's figures beside those of the model"}}}},
    {"coverage",
     {{{"stormproof coverage specs/observations/fastdds-2.6.11-ap150.jsonl --dds humble "
        "--wireless emulated-ap --samples 2 --scope np1",
        "predictions beside live measurements, one participant on each host"}}}},
    {"doctor",
     {{{"stormproof doctor specs/captures/fastdds2611_ap150_np2_ne20_r0.pcap.xz",
        "who is there, is it a storm, why, and what to change"}}}},
    {"watch",
     {{{"stormproof watch --interface lo --for 1s",
        "the counts of the last second and of all, for a second; takes the right to capture"}}}},
    {"capture summarize",
     {{{"stormproof capture summarize specs/captures/fastdds2611_ap150_np2_ne20_r0.pcap.xz",
        "what was sent, by class, and whether all was delivered"}}}},
    {"capture annotate",
     {{{"stormproof capture annotate specs/captures/fastdds2611_ap150_np2_ne20_r0.pcap.xz -o "
        "annotated.pcapng",
        "the same capture for Wireshark, with a comment on what was sent in vain"}}}},
    {"conform",
     {{{"stormproof conform specs/captures/fastdds291_veth_np1_ne2_r0.pcap.xz",
        "which shipped profile explains the capture best"},
       {"stormproof conform specs/captures/fastdds291_veth_np1_ne2_r0.pcap.xz --dds fastdds-2.9.1",
        "whether this one explains every message"}}}},
    {"validate",
     {{{"stormproof validate specs/captures/fastdds2611_ap150_np1_ne2_r0.pcap.xz --dds humble "
        "--wireless emulated-ap --samples 4",
        "what the model predicts for the captured deployment, beside what happened"}}}},
    {"properties",
     {{{"stormproof properties", "what is claimed, in words and formally"},
       {"stormproof properties --format json", "the same for programs"}}}},
    {"profile show",
     {{{"stormproof profile show humble", "every knob, and where its value comes from"},
       {"stormproof profile show specs/vendor/fastdds/large-send-buffer.xml",
        "what a vendor's file really says about discovery"}}}},
    {"profile lint",
     {{{"stormproof profile lint specs/vendor/fastdds/without-effect.xml",
        "settings that do not do what they seem to"}}}},
    {"replay",
     {{{"stormproof simulate smallest --trace run.jsonl", "writes a trace"},
       {"stormproof replay run.jsonl", "runs it again and compares every event"}}}},
    {"draw",
     {{{"stormproof draw DescriptorRepair --format svg -o repair.svg", "a machine as a picture"},
       {"stormproof draw composition --dds humble", "what happens between the machines"}}}},
    {"museum",
     {{{"stormproof museum", "real defects of DDS implementations, before and after their repair"},
       {"stormproof museum E3", "one that is open: how it breaks, and what repairs it"}}}},
    {"mutate", {{{"stormproof mutate --mutant repairs-unasked", "who notices this mistake?"}}}},
    {"list",
     {{{"stormproof list", "everything that has a name"},
       {"stormproof list profiles", "DDS profiles, and which ROS 2 distribution ships what"},
       {"stormproof list mutants --format json", "for programs"}}}},
    {"help",
     {{{"stormproof help simulate", "the same as stormproof simulate --help"},
       {"stormproof help profile show", "of a command below another one"}}}},
    {"completion bash",
     {{{"stormproof completion bash >stormproof.bash",
        "for ~/.bashrc, or /etc/bash_completion.d"}}}},
    {"completion zsh", {{{"stormproof completion zsh >_stormproof", "for a folder of fpath"}}}},
    {"completion fish",
     {{{"stormproof completion fish >stormproof.fish", "for ~/.config/fish/completions"}}}},
    {"man", {{{"stormproof man >stormproof.1", "man ./stormproof.1 shows it"}}}},
};

}  // namespace

std::span<const Example> examples_of(std::string_view command) {
  for (const OfCommand& one : all_examples) {
    if (one.command != command) continue;
    std::size_t count = 0;
    while (count < one.examples.size() && !one.examples[count].line.empty()) ++count;
    return std::span{one.examples}.first(count);
  }
  return {};
}

std::string examples_text(std::string_view command) {
  std::string text;
  for (const Example& example : examples_of(command)) {
    text += fmt::format("{}\n  {}\n      {}", text.empty() ? "Examples:" : "", example.line,
                        example.what);
  }
  return text;
}

std::string front_page() {
  return R"(Will these ROS 2 nodes find each other over this Wi-Fi, and how long will it take?

Will my deployment discover itself in time? Test runs and properties.
  stormproof simulate wifi-5x20-fastdds
  stormproof fuzz smallest --runs 20 --loss 2%

Is the protocol right? Proofs, counterexamples and pictures of its rules.
  stormproof check smallest
  stormproof draw composition

What does this change of a DDS profile do? For reviews and CI.
  stormproof diff humble jazzy --over smallest
  stormproof profile lint specs/vendor/fastdds/without-effect.xml

What is wrong on my robots? From a capture of their traffic.
  stormproof doctor specs/captures/fastdds2611_ap150_np2_ne20_r0.pcap.xz

Your own system: 'stormproof init'.
All commands: 'stormproof help'; one of them, with examples: 'stormproof help simulate'.
What has a name (scenarios, profiles, properties, …): 'stormproof list'.
)";
}

}  // namespace stormproof::cli
