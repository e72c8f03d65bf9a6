/* What is wider than its column is reached by keys as well; the theme makes these boxes after the page has been read. */
const reach = () => document.querySelectorAll(".md-typeset__scrollwrap, .formula, .highlight code, .doc-signature code").forEach(box => {
  if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
});
addEventListener("load", () => { reach(); new MutationObserver(reach).observe(document.body, { childList: true, subtree: true }); });
addEventListener("resize", reach);
