# Of comments that Doxygen reads: what it would take for an HTML tag or a link is plain text. Lines that are indented further are
# code, which Doxygen leaves alone.
while (<>)
{
    if (m{///<? ?[^ ]})
    {
        s/<([A-Za-z0-9]+)>/&lt;$1&gt;/g;
        # of a sentence behind it Sphinx keeps the first word
        s/\\throws\b/Throws/g;
        s/#([A-Za-z])/\\#$1/g;
        s{`([^`]*&lt;[^`]*)`}{<tt>$1</tt>}g;
    }
    print;
}
