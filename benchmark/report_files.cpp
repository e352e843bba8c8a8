#include "report_files.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

#include <nlohmann/json.hpp>

#include "light_field_depth/io/files.h"

namespace light_field_depth::benchmark
{
namespace
{
void appendRow(const std::vector<std::string>& cells, std::string& text)
{
  text += "|";
  for (const std::string& cell : cells)
  {
    text.append(" ").append(cell).append(" |");
  }
  text += "\n";
}

/// The name that Linux gives the processor, or "" elsewhere.
std::string processorName()
{
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
  {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "";
}

}  // namespace

std::string toMarkdown(const Table& table)
{
  std::string text;
  appendRow(table.header, text);
  text += "|";
  for (std::size_t i = 0; i < table.header.size(); ++i)
  {
    text += "---|";
  }
  text += "\n";
  for (const auto& row : table.rows)
  {
    appendRow(row, text);
  }
  return table.note.empty() ? text : text + "\n" + table.note + "\n";
}

std::string fixed(double value, int decimals)
{
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

nlohmann::json describeMachine(const Settings& settings)
{
  nlohmann::json machine;
  machine["processor"] = processorName();
  machine["processors"] = std::thread::hardware_concurrency();
  machine["compiler"] = __VERSION__;
  machine["threads"] = settings.threads;
  machine["runs"] = settings.runs;
  return machine;
}

void publishTable(const Settings& settings, const std::string& name, const Table& table)
{
  const std::string text = toMarkdown(table);
  std::cout << text << std::flush;
  if (!settings.results.empty())
  {
    makeFolder(settings.results);
    writeFile(std::filesystem::path(settings.results) / (name + ".md"), text);
  }
}

void publish(const Settings& settings, const std::string& name, const Table& table,
             const nlohmann::json& report)
{
  publishTable(settings, name, table);
  if (!settings.results.empty())
  {
    writeFile(std::filesystem::path(settings.results) / (name + ".json"), report.dump(2) + "\n");
  }
}

}  // namespace light_field_depth::benchmark
