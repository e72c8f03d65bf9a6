// Questions to the server, which is told the whole scene with each and keeps nothing.
export const TOKEN = {"X-Token": new URLSearchParams(location.search).get("token") ?? ""};

export async function ask(question, given, signal) {
  try {
    const answer = await fetch("/" + question, {
      method: "POST", headers: {"Content-Type": "application/json", ...TOKEN}, body: JSON.stringify(given), signal});
    return await answer.json();
  } catch (error) {
    return {errors: [{key: "", text: "The program that makes this page no longer answers: start it again"}]};
  }
}
