// Links where compiledRegex.cpp defines all that its header declares to be defined elsewhere.

#include "compiledRegex.cpp"

int main()
{
    const std::string text = "a1";
    std::smatch found;
    return std::regex_search(text, found, std::regex("[0-9]")) ? 0 : 1;
}
