#include "engine/liggghts/screenWarnings.h"

#include "engine/demEngine.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/types.h>

namespace clepsydra
{

namespace
{

const std::string warningWord = "WARNING";

/// The text of a warning: LIGGGHTS prints "WARNING: <text> (<file>:<line>)".
std::string textOf(const std::string& line)
{
    const std::size_t begin = line.find_first_not_of(":! ", warningWord.size());
    if (begin == std::string::npos)
    {
        return {};
    }
    const std::size_t place = line.rfind(" (");
    const bool namesSource =
        place != std::string::npos && place > begin && line.find(".cpp:", place) != std::string::npos;
    return line.substr(begin, namesSource ? place - begin : std::string::npos);
}

std::string withoutDigits(std::string text)
{
    text.erase(
        std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; }), text.end());
    return text;
}

} // namespace

ScreenWarnings::ScreenWarnings()
{
    cookie_io_functions_t functions{};
    functions.write = [](void* self, const char* text, size_t size) {
        static_cast<ScreenWarnings*>(self)->add({text, size});
        return static_cast<ssize_t>(size);
    };
    stream_ = fopencookie(this, "w", functions);
    if (stream_ == nullptr)
    {
        throw DemEngineError(std::string("LIGGGHTS' screen output cannot be read: ") + std::strerror(errno));
    }
}

ScreenWarnings::~ScreenWarnings()
{
    std::fclose(stream_);
}

std::vector<std::string> ScreenWarnings::take()
{
    std::fflush(stream_);
    return std::exchange(warnings_, {});
}

void ScreenWarnings::add(const std::string& output)
{
    unfinishedLine_ += output;
    std::size_t end = 0;
    while ((end = unfinishedLine_.find('\n')) != std::string::npos)
    {
        const std::string line = unfinishedLine_.substr(0, end);
        unfinishedLine_.erase(0, end + 1);
        std::string text = line.rfind(warningWord, 0) == 0 ? textOf(line) : std::string();
        if (!text.empty() && known_.insert(withoutDigits(text)).second)
        {
            warnings_.push_back(std::move(text));
        }
    }
}

} // namespace clepsydra
